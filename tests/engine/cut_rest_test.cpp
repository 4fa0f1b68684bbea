// What was one body and lies in itself where it was cut stays where it is: hulls of cells reach over a cut.
#include <gtest/gtest.h>

#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

constexpr RigidId kPlug = 10;
constexpr float kHole = 0.2f, kBorder = 0.1f;  // m

/// A frame that stands, and a plug that reaches into it by `overlap` on all sides.
std::unique_ptr<RigidWorld> plugged(float thickness, float overlap, float gravity) {
    auto world = make_bullet_world(20);
    world->set_gravity({0, -gravity, 0});
    const float half = 0.5f * thickness, middle = kHole + kBorder;
    for (const float side : {-1.0f, 1.0f}) {
        const RigidId id = side < 0 ? 0 : 2;
        add_box(*world, id, {side * middle, 0, 0}, {kBorder, kHole + 2 * kBorder, half}, 1000, RigidKind::Static);
        add_box(*world, id + 1, {0, side * middle, 0}, {kHole, kBorder, half}, 1000, RigidKind::Static);
    }
    add_box(*world, kPlug, {}, {kHole + overlap, kHole + overlap, half}, 1000);
    const RigidId ids[] = {0, 1, 2, 3, kPlug};
    world->name_siblings(ids);
    return world;
}

TEST(CutRest, AWindowStaysInItsPane) {
    for (const float thickness : {0.03f, 0.1f})
        for (const float overlap : {0.005f, 0.01f, 0.02f})
            for (const float gravity : {0.0f, 9.81f}) {
                const auto world = plugged(thickness, overlap, gravity);
                for (int n = 0; n < 240; ++n) step(*world);
                const Vec3 at = world->pose(kPlug).position;
                EXPECT_LT(length(at), 0.004f) << thickness << " m, " << overlap << " m, " << gravity << ": " << at.x
                                              << " " << at.y << " " << at.z;
                if (gravity > 0) {
                    EXPECT_TRUE(world->is_asleep(kPlug));
                }
            }
}

// What has come out of it meets it as anything else does.
TEST(CutRest, WhatWasTakenOutDoesNotFallBackIntoIt) {
    const auto world = plugged(0.1f, 0.02f, 9.81f);
    for (int n = 0; n < 60; ++n) step(*world);
    const float above = 2 * (kHole + kBorder) + 0.03f;
    world->set_pose(kPlug, {{0, above, 0}, {}});
    for (int n = 0; n < 120; ++n) step(*world);
    EXPECT_NEAR(world->pose(kPlug).position.y, above - 0.01f, 0.005f);
}

}  // namespace
}  // namespace cullet
