// Balls that roll, in the rigid world alone: a solid ball on a slope gains (sin - c cos) g / 1.4, where c is its
// rolling share.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

void add_ball(RigidWorld& world, RigidId id, Vec3 at, float radius, float share) {
    RigidDescription d;
    d.radius = radius;
    d.mass = 4000 * double{radius} * radius * radius;
    const double inertia = 0.4 * d.mass * radius * radius;
    d.inertia = {inertia, inertia, inertia};
    d.rolling_share = share;
    d.rolling_friction = share * radius;
    d.pose.position = at;
    world.add(id, d);
}

/// Level triangles under a gravity that is tilted towards +x, and a ball on them at the origin.
std::unique_ptr<RigidWorld> ball_on_slope(float angle, float gravity, float radius, float share) {
    auto world = make_bullet_world(4);
    world->set_gravity({gravity * std::sin(angle), -gravity * std::cos(angle), 0});
    const Vec3 p[] = {{-200, 0, -150}, {-200, 0, 250}, {200, 0, 250}, {200, 0, -150}};
    const std::array<uint32_t, 3> t[] = {{0, 1, 2}, {0, 2, 3}};
    world->add_static_triangles(0, p, t, 0.45f, 0.2f, 1, ~0u);
    add_ball(*world, 1, {0, radius, 0}, radius, share);
    return world;
}

TEST(BallRolling, DownASlopeItGoesAsTheFormulaSays) {
    for (const float angle : {0.01f, 0.04f, 0.0872665f, 0.25f})
        for (const float share : {0.0f, 0.002f, 0.01f, 0.03f})
            for (const float radius : {0.005f, 0.1f, 1.0f})
                for (const float gravity : {0.02f, 1.0f, 9.81f, 25.0f}) {
                    auto world = ball_on_slope(angle, gravity, radius, share);
                    for (int frame = 0; frame < 300; ++frame) step(*world);
                    const float pull = std::sin(angle) - share * std::cos(angle);
                    const float way = std::max(pull, 0.0f) * gravity / 1.4f * 12.5f;
                    if (std::fabs(pull) < 1e-4f) continue;
                    EXPECT_NEAR(world->pose(1).position.x, way, 0.04f * way + 0.05f * radius)
                        << angle << ", share " << share << ", radius " << radius << ", g " << gravity;
                    EXPECT_EQ(world->is_asleep(1), pull < 0)
                        << angle << ", share " << share << ", radius " << radius << ", g " << gravity;
                }
}

TEST(BallRolling, OnTheLevelItStopsWhereTheFormulaSaysAndSleeps) {
    for (const float share : {0.01f, 0.05f, 0.135f})
        for (const float radius : {0.02f, 0.3f}) {
            auto world = ball_on_slope(0, 9.81f, radius, share);
            world->set_motion(1, {{1, 0, 0}, {0, 0, -1 / radius}});
            const float seconds = 1.4f / (share * 9.81f);
            for (int frame = 0; frame < static_cast<int>(60 * (seconds + 2)); ++frame) step(*world);
            EXPECT_NEAR(world->pose(1).position.x / (0.5f * seconds), 1, 0.06f) << share << ", " << radius;
            EXPECT_TRUE(world->is_asleep(1)) << share << ", " << radius;
        }
}

TEST(BallRolling, OfTheBallAndTheFloorTheLargerShareCounts) {
    auto world = ball_on_slope(0, 9.81f, 0.1f, 0.01f);
    world->set_rolling_share(0, 0.1f);
    world->set_motion(1, {{1, 0, 0}, {0, 0, -10}});
    for (int frame = 0; frame < 60; ++frame) step(*world);
    EXPECT_NEAR(world->motion(1).velocity.x, 1 - 0.1f * 9.81f / 1.4f, 0.02f);
}

}  // namespace
}  // namespace cullet
