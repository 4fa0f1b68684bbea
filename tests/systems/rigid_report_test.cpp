#include <gtest/gtest.h>

#include "cullet/world.hpp"

namespace cullet {
namespace {

World world_with_floor() {
    Settings settings;
    settings.limits = {64, 1, 4096, 4096, 1, 4096, 16};
    World world = std::move(World::create(settings)).value();
    const Vec3 corners[] = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    MeshView floor;
    floor.positions = corners, floor.position_count = 4, floor.indices = quad, floor.triangle_count = 2;
    EXPECT_TRUE(world.add_static(floor).ok());
    return world;
}

TEST(RigidReport, AnEmptyWorldHasNoPairsAndNoContacts) {
    World world = world_with_floor();
    world.step();
    EXPECT_EQ(world.rigid_report().pairs, 0u);
    EXPECT_EQ(world.rigid_report().contacts, 0u);
    EXPECT_EQ(world.rigid_report().sweeps, 0u);
}

TEST(RigidReport, EachBallThatLiesOnTheFloorAddsAContact) {
    World world = world_with_floor();
    for (int i = 0; i < 3; ++i) {
        SphereSettings ball;
        ball.pose.position = {static_cast<float>(i), 0.0999f, 2.5f};  // off the diagonal
        ASSERT_TRUE(world.add_sphere(ball).ok());
    }
    for (int frame = 0; frame < 5; ++frame) world.step();
    EXPECT_EQ(world.rigid_report().contacts, 3u);
    EXPECT_GE(world.rigid_report().pairs, 3u);
    EXPECT_EQ(world.rigid_report().sweeps, 0u);
}

TEST(RigidReport, ABallThatWouldPassTheFloorInAStepIsSwept) {
    World world = world_with_floor();
    SphereSettings ball;
    ball.radius = 0.02f;
    ball.pose.position = {0, 1, 0};
    ball.motion.velocity = {0, -100, 0};
    const BodyId body = world.add_sphere(ball).value();
    for (int frame = 0; frame < 3; ++frame) world.step();
    EXPECT_GE(world.rigid_report().sweeps, 1u);
    EXPECT_GT(world.pose(body).value().position.y, 0);
}

}  // namespace
}  // namespace cullet
