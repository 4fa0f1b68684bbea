// Lines of draw_debug, against what the world says by other calls.
#include "cullet/debug.hpp"

#include <gtest/gtest.h>

#include <array>

#include "systems/hulls/hull_edges.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

struct Line {
    Vec3 from, to;
    uint32_t colour;
};

std::vector<Line> lines_of(const World& world, uint32_t flags) {
    std::vector<Line> lines;
    draw_debug(
        world, flags,
        [](void* user, Vec3 from, Vec3 to, uint32_t colour) {
            static_cast<std::vector<Line>*>(user)->push_back({from, to, colour});
        },
        &lines);
    return lines;
}

size_t count_edges(std::span<const Vec3> points) {
    size_t count = 0;
    for (size_t a = 0; a < points.size(); ++a)
        for (size_t b = a + 1; b < points.size(); ++b) count += is_hull_edge(points, a, b);
    return count;
}

TEST(Debug, AHullsEdgesAreEulersCount) {
    std::vector<Vec3> cube;
    for (int k = 0; k < 8; ++k)
        cube.push_back({static_cast<float>(k & 1), static_cast<float>(k >> 1 & 1), static_cast<float>(k >> 2)});
    EXPECT_EQ(count_edges(cube), 12u);
    cube.push_back({0.4f, 0.5f, 0.6f});  // inside
    EXPECT_EQ(count_edges(cube), 12u);
    cube.back() = {0.4f, 0.5f, 1.6f};  // a roof on the top
    EXPECT_EQ(count_edges(cube), 16u);
    const Vec3 tetrahedron[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_EQ(count_edges(tetrahedron), 6u);
}

TEST(Debug, ABallHasABoxRingsAxesAndAVelocity) {
    World world = make_world(small_settings());
    SphereSettings ball;
    ball.pose.position = {1, 2, 3};
    ball.radius = 0.5f;
    ball.motion.velocity = {0, 10, 0};
    (void)world.add_sphere(ball).value();
    const std::vector<Line> box = lines_of(world, kDebugBounds);
    ASSERT_EQ(box.size(), 12u);
    for (const Line& l : box) {
        EXPECT_EQ(l.colour, kDebugAwake);
        EXPECT_NEAR(length(l.to - l.from), 1, 1e-4);
    }
    for (const Line& l : lines_of(world, kDebugHulls)) EXPECT_NEAR(length(l.from - ball.pose.position), 0.5, 1e-5);
    const std::vector<Line> velocity = lines_of(world, kDebugVelocities);
    ASSERT_EQ(velocity.size(), 1u);
    EXPECT_NEAR(velocity[0].to.y - velocity[0].from.y, 1, 1e-6);
    EXPECT_EQ(lines_of(world, kDebugCentres).size(), 3u);
    EXPECT_EQ(lines_of(world, 0).size(), 0u);
}

TEST(Debug, TouchesAreDrawnAlongTheirNormal) {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    World world = make_world(settings);
    add_floor(world);
    SphereSettings ball;
    ball.pose.position = {1, 0.1f, 2};
    (void)world.add_sphere(ball).value();
    world.step();
    const std::vector<Line> contacts = lines_of(world, kDebugContacts);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_NEAR(std::fabs(contacts[0].to.y - contacts[0].from.y), 0.05, 1e-5);
    EXPECT_EQ(contacts[0].colour, kDebugContact);
}

TEST(Debug, AHeldVaseIsSeenToCrackBeforeItBreaks) {
    Settings settings = small_settings();
    settings.units_a_frame = 2'000'000;
    Breakage b = vase_and_ball(settings);
    EXPECT_TRUE(lines_of(b.world, kDebugCracks).empty());
    bool was_held = false, was_cracked = false;
    for (int frame = 0; frame < 40 && b.world.events().fragments_born.count == 0; ++frame) {
        b.world.step();
        for (const Line& l : lines_of(b.world, kDebugHulls)) was_held = was_held || l.colour == kDebugHeld;
        was_cracked = was_cracked || !lines_of(b.world, kDebugCracks).empty();
    }
    EXPECT_TRUE(was_held);
    EXPECT_TRUE(was_cracked);
    // Piece by piece inside of the body's bounds, which queries vouch for.
    for (const Line& l : lines_of(b.world, kDebugHulls)) {
        EXPECT_LT(length(l.from), 1);
        EXPECT_LT(length(l.to), 1);
    }
}

}  // namespace
}  // namespace cullet::test
