// In gravity of tenths of a millimetre a second squared what falls together falls, and what lies sleeps.
#include <gtest/gtest.h>

#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

constexpr Vec3 kHalf{0.1f, 0.1f, 0.1f};
constexpr int kSeconds = 40;

void run(RigidWorld& world) {
    for (int n = 0; n < 60 * kSeconds; ++n) step(world);
}

TEST(FaintGravity, WhatTouchesAnotherInFallDoesNotStopInTheAir) {
    for (const float gravity : {0.0001f, 0.0003f, 0.001f}) {
        const auto world = floor_world(10);
        world->set_gravity({0, -gravity, 0});
        add_box(*world, 1, {0, 3, 0}, kHalf, 500);
        add_box(*world, 2, {0.2001f, 3, 0}, kHalf, 1000);  // beside it,
        add_box(*world, 3, {0, 3.2001f, 0}, kHalf, 1000);  // and over it
        run(*world);
        const float way = 0.5f * gravity * kSeconds * kSeconds;
        for (const auto& [id, from] : {std::pair(1, 3.0f), std::pair(2, 3.0f), std::pair(3, 3.2001f)}) {
            EXPECT_FALSE(world->is_asleep(static_cast<RigidId>(id))) << id << " at " << gravity;
            EXPECT_NEAR(world->pose(static_cast<RigidId>(id)).position.y, from - way, 0.01f) << id << " at " << gravity;
        }
    }
}

TEST(FaintGravity, WhatIsBorneSleeps) {
    for (const float gravity : {0.0001f, 0.0003f, 0.001f, 0.005f}) {
        const auto world = floor_world(10);
        world->set_gravity({0, -gravity, 0});
        for (RigidId k = 0; k < 4; ++k) add_box(*world, 1 + k, {0, 0.1f + 0.2f * real(k), 0}, kHalf, 500);
        RigidDescription ball;
        ball.radius = 0.1f, ball.mass = 1, ball.inertia = {0.004, 0.004, 0.004};
        ball.pose = {{2, 0.1f, 0}, {}};
        world->add(5, ball);
        run(*world);
        for (RigidId id = 1; id <= 5; ++id) EXPECT_TRUE(world->is_asleep(id)) << id << " at " << gravity;
    }
}

}  // namespace
}  // namespace cullet
