// Bytes of a rigid world, honest and otherwise.
#include <gtest/gtest.h>

#include <cstring>

#include "engine/byte_stream.hpp"
#include "engine/fp_mode.hpp"
#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

std::vector<uint8_t> saved(const RigidWorld& world) {
    ByteWriter out;
    world.save(out);
    return out.bytes;
}

/// The sentence that refuses the bytes, or an empty one.
std::string refusal(const std::vector<uint8_t>& bytes) {
    const auto world = make_bullet_world(4);
    ByteReader in(bytes, "test", "");
    const Result<void> loaded = world->load(in);
    return loaded.ok() ? "" : loaded.error();
}

bool same(Vec3 a, Vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// A sheet of 32 triangles, which stays triangles, as the only body.
std::unique_ptr<RigidWorld> sheet() {
    auto world = make_bullet_world(4);
    std::vector<Vec3> points;
    std::vector<std::array<uint32_t, 3>> triangles;
    for (uint32_t k = 0; k < 25; ++k) points.push_back({real(k % 5), 0, real(k / 5)});
    for (uint32_t k = 0; k < 16; ++k) {
        const uint32_t a = k / 4 * 5 + k % 4;
        triangles.push_back({a, a + 5, a + 1});
        triangles.push_back({a + 1, a + 5, a + 6});
    }
    world->add_static_triangles(0, points, triangles, 0.5f, 0, 1, ~0u);
    return world;
}

TEST(RigidSave, ATreeOfTrianglesInWhichABoxIsTwoBoxesChildIsRefused) {
    constexpr size_t kTriangle = 42, kNode = 32,
                     kAfter = 93;  // bytes; kAfter: the body behind its tree, and three counts
    std::vector<uint8_t> bytes = saved(*sheet());
    EXPECT_EQ(refusal(bytes), "");
    const auto number = [&](size_t place) {
        uint32_t value = 0;
        std::memcpy(&value, bytes.data() + place, sizeof value);
        return value;
    };
    size_t nodes = 1, first = bytes.size() - kAfter - kNode;
    while (number(first - 32 * kTriangle - 4) != nodes || number(first - 32 * kTriangle - 8) != 32) {
        ASSERT_LT(++nodes, 64u);
        first -= kNode;
    }
    const auto first_child = [&](size_t node) { return first + node * kNode + 24; };
    const uint32_t left = number(first_child(0));
    ASSERT_EQ(number(first_child(left) + 4), 0u) << "has children, and so has the box beside it";
    const uint32_t shared = number(first_child(left + 1));
    std::memcpy(bytes.data() + first_child(left), &shared, sizeof shared);
    EXPECT_NE(refusal(bytes).find("leads nowhere"), std::string::npos) << refusal(bytes);
}

// A birth puts off the search for seams to the next step.
TEST(RigidSave, WhatIsSavedBetweenABirthAndTheNextStepGoesOnAlike) {
    auto world = floor_world(4);
    RigidDescription d;
    const std::vector<Vec3> left = box_points({0.1f, 0.1f, 0.1f}, {-0.1f, 0, 0}),
                            right = box_points({0.1f, 0.1f, 0.1f}, {0.1f, 0, 0});
    const ConvexPiece pieces[] = {{left, 0}, {right, 1}};
    d.pieces = pieces;
    d.mass = 1;
    d.inertia = {1, 1, 1};
    d.pose.position = {0, 0.11f, 0};
    world->add(1, d);
    d.parent = 1;
    d.pose.position = {0.05f, 0.3f, 0};
    world->add(2, d);
    const std::vector<uint8_t> born = saved(*world);
    const auto twin = make_bullet_world(4);
    ByteReader in(born, "test", "");
    ASSERT_TRUE(twin->load(in).ok()) << in.trouble();
    EXPECT_EQ(saved(*twin), born);
    for (RigidWorld* one : {world.get(), twin.get()})
        for (int n = 0; n < 30; ++n) step(*one);
    EXPECT_EQ(saved(*twin), saved(*world));
    EXPECT_NE(saved(*world), born);
}

// The sort of manifolds asserts that none tie.
TEST(RigidSave, ManifoldsWithoutPointsKeepTheirOrder) {
    auto world = floor_world(4);
    const std::vector<Vec3> left = box_points({0.1f, 0.1f, 0.1f}, {-0.2f, 0, 0}),
                            right = box_points({0.1f, 0.1f, 0.1f}, {0.2f, 0, 0});
    const ConvexPiece pieces[] = {{left, 7}, {right, 7}};  // of one cell
    RigidDescription d;
    d.pieces = pieces;
    d.mass = 1;
    d.inertia = {1, 1, 1};
    d.pose.position = {0, 0.1f, 0};
    world->add(1, d);
    world->detect(kStep);
    ASSERT_EQ(world->contacts().size(), 8u);
    world->skip_contacts(0, 1);
    world->solve(kStep);
    const std::vector<uint8_t> bytes = saved(*world);
    const auto twin = make_bullet_world(4);
    ByteReader in(bytes, "test", "");
    ASSERT_TRUE(twin->load(in).ok()) << in.trouble();
    EXPECT_EQ(saved(*twin), bytes);
}

/// A box that is thrown into a heap of sleepers, saved before, while and after they wake: what is loaded takes the same
/// step to the bit, and the same bodies wake.
TEST(RigidSave, SleepersThatAreAboutToBeWokenWakeInWhatIsLoaded) {
    const FpMode mode;
    constexpr uint32_t kShards = 16, kBox = 1 + kShards;
    const auto world = floor_world(32);
    drop_shards(*world, 1, kShards);
    const auto asleep = [](const RigidWorld& of) {
        uint32_t count = 0;
        for (RigidId id = 1; id <= kShards; ++id) count += of.is_asleep(id);
        return count;
    };
    for (int frame = 0; frame < 900 && asleep(*world) < kShards; ++frame) step(*world);
    ASSERT_EQ(asleep(*world), kShards);
    add_box(*world, kBox, {-1, 0.15f, 0.02f}, {0.1f, 0.1f, 0.1f}, 4000);
    world->set_motion(kBox, {{8, 0, 0}, {}});
    bool has_slept = false, has_woken = false;  // when saved
    for (int frame = 0; frame < 20; ++frame) {
        const uint32_t sleepers = asleep(*world);
        has_slept = has_slept || sleepers == kShards;
        has_woken = has_woken || sleepers < kShards / 2;
        const std::vector<uint8_t> bytes = saved(*world);
        const auto twin = make_bullet_world(32);
        ByteReader in(bytes, "test", "");
        ASSERT_TRUE(twin->load(in).ok()) << in.trouble();
        step(*world), step(*twin);
        for (RigidId id = 1; id <= kBox; ++id) {
            const Motion a = world->motion(id), b = twin->motion(id);
            EXPECT_EQ(twin->is_asleep(id), world->is_asleep(id)) << frame << ": " << id;
            EXPECT_TRUE(same(twin->pose(id).position, world->pose(id).position)) << frame << ": " << id;
            EXPECT_TRUE(same(a.velocity, b.velocity)) << frame << ": " << id;
            EXPECT_TRUE(same(a.angular_velocity, b.angular_velocity)) << frame << ": " << id;
        }
    }
    EXPECT_TRUE(has_slept && has_woken);
}

}  // namespace
}  // namespace cullet
