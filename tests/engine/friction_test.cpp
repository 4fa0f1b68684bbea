// Friction is the same in every direction: bounds of two ways by themselves turn what slides towards one of them, and
// hold more between them.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

constexpr float kGravity = 9.81f;
constexpr Vec3 kHalf{0.1f, 0.02f, 0.1f};

Quat about_y(float angle) {
    return {0, std::sin(0.5f * angle), 0, std::cos(0.5f * angle)};
}

/// A flat box on a level floor under a gravity that leads down a slope of `slope`, towards `heading`.
std::unique_ptr<RigidWorld> plate_on_floor(float slope, float heading, float turn) {
    auto world = floor_world(4);
    world->set_gravity({kGravity * std::sin(slope) * std::cos(heading), -kGravity * std::cos(slope),
                        kGravity * std::sin(slope) * std::sin(heading)});
    add_box(*world, 1, {0, kHalf.y, 0}, kHalf, 2000, RigidKind::Dynamic, about_y(turn));
    return world;
}

float friction_of_plate() {
    return std::sqrt(0.45f * RigidDescription{}.friction);
}

TEST(Friction, WhatSlidesGoesStraightAndAsFarInEveryDirection) {
    const float speed = 5, way = speed * speed / (2 * friction_of_plate() * kGravity);
    for (int k = 0; k < 16; ++k) {
        const float heading = 0.4f * real(k), turn = 0.23f * real(k);
        auto world = plate_on_floor(0, 0, turn);
        world->set_motion(1, {{speed * std::cos(heading), 0, speed * std::sin(heading)}, {}});
        for (int frame = 0; frame < 180; ++frame) step(*world);
        const Vec3 at = world->pose(1).position;
        EXPECT_NEAR(at.x * std::cos(heading) + at.z * std::sin(heading), way, 0.04f * way) << heading;
        EXPECT_NEAR(at.z * std::cos(heading) - at.x * std::sin(heading), 0, 0.01f * way) << heading;
    }
}

TEST(Friction, ASlopeHoldsAndLetsGoAtTheSameAngleInEveryDirection) {
    const float angle = std::atan(friction_of_plate());
    for (int k = 0; k < 16; ++k) {
        const float heading = 0.4f * real(k), turn = 0.23f * real(k);
        for (const bool is_steep : {false, true}) {
            auto world = plate_on_floor(is_steep ? 1.08f * angle : 0.92f * angle, heading, turn);
            for (int frame = 0; frame < 120; ++frame) step(*world);
            const Vec3 at = world->pose(1).position;
            const float way = std::sqrt(at.x * at.x + at.z * at.z);
            if (is_steep)
                EXPECT_GT(way, 0.3f) << heading;
            else
                EXPECT_LT(way, 0.01f) << heading;
        }
    }
}

}  // namespace
}  // namespace cullet
