// Friction is the same in every direction: bounds of two ways by themselves turn what slides towards one of them, and
// hold more between them.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

constexpr float kGravity = 9.81f;
constexpr Vec3 kHalf{0.1f, 0.02f, 0.1f};
// Unit vectors, x and z, on all sides of the axes and between them.
constexpr float kWays[][2] = {{1, 0},         {0.96f, 0.28f},  {0.8f, 0.6f},  {0.6f, 0.8f},
                              {0.28f, 0.96f}, {-0.28f, 0.96f}, {-0.8f, 0.6f}, {-0.96f, -0.28f},
                              {-0.6f, -0.8f}, {0, -1},         {0.8f, -0.6f}, {0.96f, -0.28f}};

/// About y by some other angle for each k.
Quat turn_of(size_t k) {
    return normalised(Quat{0, 0.2f * real(k), 0, 1});
}

/// A flat box on a level floor, under a gravity that leads along a way down a slope that rises so much a metre.
std::unique_ptr<RigidWorld> plate_on_slope(float rise, const float (&way)[2], Quat turn) {
    auto world = floor_world(4);
    const float down = kGravity / std::sqrt(1 + rise * rise);
    world->set_gravity({rise * down * way[0], -down, rise * down * way[1]});
    add_box(*world, 1, {0, kHalf.y, 0}, kHalf, 2000, RigidKind::Dynamic, turn);
    return world;
}

float friction_of_plate() {
    return std::sqrt(0.45f * RigidDescription{}.friction);
}

TEST(Friction, WhatSlidesGoesStraightAndAsFarInEveryDirection) {
    const float speed = 5, distance = speed * speed / (2 * friction_of_plate() * kGravity);
    for (size_t k = 0; k < std::size(kWays); ++k) {
        const auto& [x, z] = kWays[k];
        auto world = plate_on_slope(0, kWays[k], turn_of(k));
        world->set_motion(1, {{speed * x, 0, speed * z}, {}});
        for (int frame = 0; frame < 180; ++frame) step(*world);
        const Vec3 at = world->pose(1).position;
        EXPECT_NEAR(at.x * x + at.z * z, distance, 0.04f * distance) << x << ", " << z;
        EXPECT_NEAR(at.z * x - at.x * z, 0, 0.01f * distance) << x << ", " << z;
    }
}

TEST(Friction, ASlopeHoldsAndLetsGoAtTheSameRiseInEveryDirection) {
    for (size_t k = 0; k < std::size(kWays); ++k)
        for (const bool is_steep : {false, true}) {
            auto world = plate_on_slope((is_steep ? 1.08f : 0.92f) * friction_of_plate(), kWays[k], turn_of(k));
            for (int frame = 0; frame < 120; ++frame) step(*world);
            const Vec3 at = world->pose(1).position;
            const float gone = std::sqrt(at.x * at.x + at.z * at.z);
            if (is_steep)
                EXPECT_GT(gone, 0.3f) << kWays[k][0] << ", " << kWays[k][1];
            else
                EXPECT_LT(gone, 0.01f) << kWays[k][0] << ", " << kWays[k][1];
        }
}

}  // namespace
}  // namespace cullet
