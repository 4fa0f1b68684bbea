// Touches of bodies in flight, foreseen in the rigid world.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "engine/fp_mode.hpp"
#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

bool same(Vec3 a, Vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}
bool same(const RigidContact& p, const RigidContact& q) {
    return p.a == q.a && p.b == q.b && p.cell_a == q.cell_a && p.cell_b == q.cell_b && same(p.normal, q.normal) &&
           p.distance == q.distance && p.approach_speed == q.approach_speed;
}

/// Pose and motion come in the same bits. So do contacts but where a pair that was watched for some steps knows an axis
/// that one which is met anew has to find: those lie on the same patch. Shards of 0.1 m that fly at a floor,
/// a box and each other, spinning, at up to 30 m/s.
TEST(Foresee, AnUndisturbedFlightEndsWhereItWasForeseen) {
    const FpMode mode;
    std::mt19937 random(7);
    const auto draw = [&] { return static_cast<float>(random() % 20001) / 10000.0f - 1; };
    uint32_t touched = 0, kept = 0, in_the_same_bits = 0;
    for (int flight = 0; flight < 120; ++flight) {
        const auto world = floor_world(8);
        add_box(*world, 1, {0, 0.3f, 0}, {0.25f, 0.29f, 0.04f}, 2000, RigidKind::Static);
        const Quat turned = normalised(Quat{draw(), draw(), draw(), draw()});
        add_shard(*world, 2, {0.3f * draw(), 0.5f + 0.3f * draw(), 0.9f}, turned);
        world->set_motion(2, {{2 * draw(), 2 * draw(), -6 - 24 * std::fabs(draw())}, {9 * draw(), 9 * draw(), draw()}});
        ForeseenTouch told;
        bool is_told = false;
        for (uint32_t frame = 0, due = 0; frame < 20; ++frame) {
            world->detect(kStep);
            if (is_told && frame == due) {
                const auto contacts = world->contacts();
                ++touched;
                kept += contacts.size() == told.contact_count;
                bool are_same = contacts.size() == told.contact_count;
                for (uint32_t c = 0; are_same && c < told.contact_count; ++c) {
                    const RigidContact &p = contacts[c], &q = told.contacts[c];
                    are_same = same(p, q);
                    EXPECT_EQ(p.cell_b, q.cell_b) << flight;
                    EXPECT_GT(dot(p.normal, q.normal), 0.999f) << flight;
                    EXPECT_NEAR(p.approach_speed, q.approach_speed, 0.02f * std::fabs(p.approach_speed)) << flight;
                }
                in_the_same_bits += are_same;
                const Pose at = world->pose(2);
                EXPECT_TRUE(same(at.position, told.pose.position)) << flight;
                EXPECT_TRUE(same(world->motion(2).velocity, told.motion.velocity)) << flight;
                EXPECT_TRUE(same(world->motion(2).angular_velocity, told.motion.angular_velocity)) << flight;
                break;
            }
            if (!is_told && world->foresee(2, kStep, 8, told)) is_told = true, due = frame + told.steps;
            EXPECT_TRUE(is_told || world->contacts().empty()) << flight << ": a touch that nobody foresaw";
            world->solve(kStep);
        }
    }
    EXPECT_GT(touched, 60u);
    EXPECT_EQ(kept, touched);
    EXPECT_GE(10 * in_the_same_bits, 9 * touched);
}

TEST(Foresee, ChangesNothing) {
    const FpMode mode;
    const auto play = [](bool foresees) {
        const auto world = floor_world(64);
        drop_shards(*world, 1, 40);
        ForeseenTouch told;
        std::vector<Vec3> places;
        for (int frame = 0; frame < 90; ++frame) {
            world->detect(kStep);
            for (RigidId id = 1; foresees && id <= 40; ++id) (void)world->foresee(id, kStep, 8, told);
            world->solve(kStep);
        }
        for (RigidId id = 1; id <= 40; ++id) places.push_back(world->pose(id).position);
        return places;
    };
    const auto plain = play(false), foreseen = play(true);
    for (size_t k = 0; k < plain.size(); ++k) EXPECT_TRUE(same(plain[k], foreseen[k])) << k;
}

TEST(Foresee, WhatIsTouchedHeldAsleepOrFarFromAllHasNoFlight) {
    const FpMode mode;
    const auto world = floor_world(8);
    add_box(*world, 1, {0, 5, 0}, {0.1f, 0.1f, 0.1f}, 1000);
    add_box(*world, 2, {2, 0.1f, 0}, {0.1f, 0.1f, 0.1f}, 1000);
    add_box(*world, 3, {-2, 0.2f, 0}, {0.1f, 0.1f, 0.1f}, 1000);
    world->detect(kStep);
    ForeseenTouch told;
    EXPECT_FALSE(world->foresee(1, kStep, 8, told));  // 5 m above
    EXPECT_FALSE(world->foresee(2, kStep, 8, told));  // stands on the floor
    EXPECT_TRUE(world->foresee(3, kStep, 12, told));  // 0.1 m above: falls for 0.14 s
    EXPECT_GE(told.steps, 8u);
    world->hold(3);
    EXPECT_FALSE(world->foresee(3, kStep, 12, told));
    EXPECT_FALSE(world->foresee(7, kStep, 8, told));  // nobody
}

/// A slab of a metre that stands on its edge and leans falls over onto a block, 0.6 m high: about its foot, faster and
/// faster.
TEST(Foresee, WhatTopplesIsForeseenByHowItToppledSoFar) {
    const FpMode mode;
    const auto world = floor_world(8);
    // It leans by 0.3 rad.
    const Quat turned = normalised(Quat{0, 0, -0.1494f, 0.9888f});
    const Vec3 corner{0.05f, -0.5f, 0};
    add_box(*world, 1, Vec3{0.1f, 0, 0} - rotate(turned, corner), {0.05f, 0.5f, 0.3f}, 2000, RigidKind::Dynamic,
            turned);
    add_box(*world, 2, {0.95f, 0.3f, 0}, {0.15f, 0.3f, 0.3f}, 2000, RigidKind::Static);
    std::vector<std::pair<uint32_t, ForeseenTouch>> told;  // in which frame
    for (uint32_t frame = 0; frame < 120; ++frame) {
        world->detect(kStep);
        for (const RigidContact& c : world->contacts()) {
            if (c.a != 1 || c.b != 2) continue;
            uint32_t early = 0;
            for (const auto& [at, touch] : told) {
                if (at + 6 < frame) continue;  // the last six frames
                ++early;
                EXPECT_NEAR(static_cast<float>(at + touch.steps), static_cast<float>(frame), 1) << at;
                EXPECT_NEAR(touch.contacts[0].approach_speed, c.approach_speed, 0.1f * c.approach_speed) << at;
            }
            EXPECT_EQ(early, 6u);
            EXPECT_GT(c.approach_speed, 1);
            return;
        }
        ForeseenTouch touch;
        if (world->is_held_up(1) && world->foresee(1, kStep, 8, touch)) told.push_back({frame, touch});
        world->solve(kStep);
    }
    FAIL() << "it did not fall over";
}

/// Pieces of one shower touch each other on their way; what lies on something that stands does not fly on.
TEST(Foresee, TwoThatFlyTogetherHaveAFlightThoughTheyTouch) {
    const FpMode mode;
    const auto world = floor_world(8);
    add_box(*world, 1, {0, 0.55f, 0}, {0.1f, 0.1f, 0.1f}, 1000);
    add_box(*world, 2, {0.201f, 0.55f, 0}, {0.1f, 0.1f, 0.1f}, 1000);
    for (const RigidId id : {1u, 2u}) world->set_motion(id, {{0, -4, 0}, {}});
    add_box(*world, 3, {2, 0.1f, 0}, {0.1f, 0.1f, 0.1f}, 1000);
    world->detect(kStep);
    for (const RigidId id : {1u, 2u}) {
        EXPECT_TRUE(world->is_touched(id));
        EXPECT_FALSE(world->is_held_up(id));
        ForeseenTouch told;
        ASSERT_TRUE(world->foresee(id, kStep, 8, told)) << id;
        for (uint32_t c = 0; c < told.contact_count; ++c)
            EXPECT_TRUE(told.contacts[c].a == 0 || told.contacts[c].b == 0);
    }
    EXPECT_TRUE(world->is_held_up(3));
}

}  // namespace
}  // namespace cullet
