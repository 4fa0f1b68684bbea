// Lengths go with sizes, patience with gravity: what is thin lies on the floor as what is thick does, and nothing stops
// in mid-air.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/random.hpp"
#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

/// A plate of these half sides with the margin that pieces of its wall have.
void add_plate_of(RigidWorld& world, RigidId id, Vec3 at, Vec3 half, Quat turned) {
    RigidDescription d;
    d.margin = std::min(0.001f, 0.4f * std::min({half.x, half.y, half.z}));
    const std::vector<Vec3> points = box_points(half - Vec3{d.margin, d.margin, d.margin}, {});
    const ConvexPiece piece{points, 0};
    d.pieces = {&piece, 1};
    d.mass = 2400 * 8 * double{half.x} * half.y * half.z;
    const double s = d.mass / 3, x = half.x * half.x, y = half.y * half.y, z = half.z * half.z;
    d.inertia = {s * (y + z), s * (x + z), s * (x + y)};
    d.pose = {at, turned};
    world.add(id, d);
}

float lowest_corner(const RigidWorld& world, RigidId id, Vec3 half) {
    float lowest = 1e30f;
    const Pose pose = world.pose(id);
    for (const Vec3 corner : box_points(half, {}))
        lowest = std::min(lowest, (rotate(pose.orientation, corner) + pose.position).y);
    return lowest;
}

float any(uint32_t which, uint32_t number) {
    return static_cast<float>(Random{31}.uniform(which, number));
}

Quat any_turn(uint32_t which) {
    return normalised(Quat{any(which, 0) - 0.5f, any(which, 1) - 0.5f, any(which, 2) - 0.5f, any(which, 3) - 0.5f});
}

// A plate of ten by eight walls, from as high as it is long: from the shards of a vase of 1.5 cm to those of a tower.
TEST(Lengths, APlateRestsOnTheFloorToATenthOfItsWallWhateverItsSize) {
    for (const float wall : {0.00025f, 0.0008f, 0.0025f, 0.005f, 0.05f, 0.33f})
        for (uint32_t k = 0; k < 8; ++k) {
            const Vec3 half{5 * wall, 0.5f * wall, 4 * wall};
            auto world = floor_world(4);
            add_plate_of(*world, 1, {0, 20 * wall, 0}, half, any_turn(k));
            const float seconds = 3 + 15 * std::sqrt(wall);
            for (int frame = 0; frame < static_cast<int>(60 * seconds) && !world->is_asleep(1); ++frame) step(*world);
            EXPECT_TRUE(world->is_asleep(1)) << 1000 * wall << " mm, " << k;
            const float lowest = lowest_corner(*world, 1, half);
            EXPECT_GT(lowest, -0.1f * wall) << 1000 * wall << " mm, " << k;
            EXPECT_LT(lowest, 0.3f * wall + 0.0001f) << 1000 * wall << " mm, " << k;
        }
}

/// A chip of a curved wall, of one piece: bent like a sphere of 20 walls, some walls wide, with a ragged rim.
std::vector<Vec3> chip_points(float wall, uint32_t which) {
    std::vector<Vec3> points;
    const float sphere = 20 * wall, wide = (3 + 3 * any(which, 10)) * wall;
    for (uint32_t k = 0; k < 12; ++k) {
        const float angle = 0.5236f * (real(k) + any(which, 20 + k)), out = wide * (0.5f + 0.5f * any(which, 40 + k));
        for (const float r : {sphere - 0.4f * wall, sphere + 0.4f * wall}) {
            const Vec3 way = normalised(Vec3{out * std::cos(angle), sphere, out * std::sin(angle)});
            points.push_back(r * way - Vec3{0, sphere, 0});
        }
    }
    for (const float x : {-0.3f, 0.3f})
        for (const float z : {-0.3f, 0.3f}) {
            const Vec3 way = normalised(Vec3{x * wide, sphere, z * wide});
            points.push_back((sphere + 0.4f * wall) * way - Vec3{0, sphere, 0});
        }
    return points;
}

// A step of gravity turns a chip of two millimetres over, a corner at a time into the floor.
TEST(Lengths, ChipsOfACurvedWallLieOnTheFloorToATenthOfTheirWallWhateverTheirSize) {
    for (const float wall : {0.00025f, 0.0008f, 0.0025f, 0.005f})
        for (uint32_t k = 0; k < 40; ++k) {
            const std::vector<Vec3> points = chip_points(wall, k);
            const ConvexPiece piece{points, 0};
            RigidDescription d;
            d.margin = std::min(0.001f, 0.2f * wall);
            d.pieces = {&piece, 1};
            d.mass = 2400 * 50 * double{wall} * wall * wall;
            const double about = d.mass * 5 * double{wall} * wall;
            d.inertia = {about, 2 * about, about};
            d.pose = {{0, 15 * wall, 0}, any_turn(k)};
            d.motion = {{2 * any(k, 5), -1, 0}, {100 * any(k, 6), 0, 50}};
            auto world = floor_world(2);
            world->add(1, d);
            for (int frame = 0; frame < 480 && !world->is_asleep(1); ++frame) step(*world);
            EXPECT_TRUE(world->is_asleep(1)) << 1000 * wall << " mm, " << k;
            float lowest = 1e30f;
            const Pose pose = world->pose(1);
            for (const Vec3 p : points)
                lowest = std::min(lowest, (rotate(pose.orientation, p) + pose.position).y - d.margin);
            EXPECT_GT(lowest, -0.1f * wall) << 1000 * wall << " mm, " << k;
            EXPECT_LT(lowest, 0.1f * wall) << 1000 * wall << " mm, " << k;
        }
}

// Plates that fall on each other: none goes below the floor, all of them sleep.
TEST(Lengths, AHeapOfThinPlatesStaysAboveTheFloorAndSleeps) {
    for (const float wall : {0.00025f, 0.001f, 0.005f}) {
        constexpr uint32_t kPlates = 12;
        const Vec3 half{5 * wall, 0.5f * wall, 4 * wall};
        auto world = floor_world(kPlates + 1);
        for (uint32_t k = 1; k <= kPlates; ++k) {
            const Vec3 at{2 * wall * any(k, 4), 12 * wall * real(k), 2 * wall * any(k, 5)};
            add_plate_of(*world, k, at, half, any_turn(k));
        }
        for (int frame = 0; frame < 480; ++frame) step(*world);
        for (uint32_t k = 1; k <= kPlates; ++k) {
            EXPECT_TRUE(world->is_asleep(k)) << 1000 * wall << " mm, " << k;
            EXPECT_GT(lowest_corner(*world, k, half), -0.3f * wall) << 1000 * wall << " mm, " << k;
        }
    }
}

TEST(Lengths, WhatNothingTouchesFallsHoweverWeakGravityIs) {
    for (const float gravity : {0.001f, 0.003f, 0.01f, 0.02f, 0.1f, 1.0f, 9.81f, 25.0f})
        for (const float size : {0.002f, 0.05f, 1.0f}) {
            auto world = make_bullet_world(2);
            world->set_gravity({0, -gravity, 0});
            add_plate_of(*world, 1, {0, 0, 0}, {size, 0.2f * size, size}, {});
            for (int frame = 0; frame < 600; ++frame) step(*world);
            EXPECT_FALSE(world->is_asleep(1)) << gravity << " m/s2, " << size << " m";
            EXPECT_NEAR(world->pose(1).position.y / (-50 * gravity), 1, 0.02) << gravity << " m/s2, " << size << " m";
        }
}

// Two millimetres beside a wall, within the range of contacts, up and down again.
TEST(Lengths, WhatTurnsRoundBesideAWallComesDownAgain) {
    for (const float gravity : {0.01f, 0.1f, 1.0f, 9.81f}) {
        auto world = make_bullet_world(3);
        world->set_gravity({0, -gravity, 0});
        add_box(*world, 0, {0.3f, 0, 0}, {0.2f, 50, 0.2f}, 1000, RigidKind::Static);
        add_box(*world, 1, {0.048f, 0, 0}, {0.05f, 0.05f, 0.05f}, 1000);
        const float up = gravity;  // at the top after a second
        world->set_motion(1, {{0, up, 0}, {}});
        for (int frame = 0; frame < 240; ++frame) step(*world);
        EXPECT_NEAR(world->motion(1).velocity.y, up - 4 * gravity, 0.05f * gravity) << gravity;
        EXPECT_LT(world->pose(1).position.y, -3.8f * gravity) << gravity;
    }
}

TEST(Lengths, WithoutGravityWhatDriftsDriftsOnAndWhatStandsSleeps) {
    for (const float speed : {0.0002f, 0.001f, 0.01f, 0.3f})
        for (const float size : {0.002f, 0.05f, 0.5f}) {
            auto world = make_bullet_world(2);
            world->set_gravity({});
            add_plate_of(*world, 1, {0, 0, 0}, {size, 0.2f * size, size}, any_turn(5));
            world->set_motion(1, {{speed, 0, 0}, {}});
            for (int frame = 0; frame < 900; ++frame) step(*world);
            EXPECT_NEAR(world->pose(1).position.x / (15 * speed), 1, 0.01) << speed << " m/s, " << size << " m";
        }
    auto world = make_bullet_world(2);
    world->set_gravity({});
    add_box(*world, 1, {0, 0, 0}, {0.05f, 0.05f, 0.05f}, 1000);
    for (int frame = 0; frame < 600; ++frame) step(*world);
    EXPECT_TRUE(world->is_asleep(1));
}

TEST(Lengths, WhatLiesOnTheFloorSleepsUnderAnyGravity) {
    for (const float gravity : {0.01f, 0.1f, 1.0f, 9.81f, 25.0f}) {
        auto world = floor_world(2);
        world->set_gravity({0, -gravity, 0});
        add_box(*world, 1, {0, 0.051f, 0}, {0.08f, 0.05f, 0.06f}, 1000);
        for (int frame = 0; frame < 900; ++frame) step(*world);
        EXPECT_TRUE(world->is_asleep(1)) << gravity;
        EXPECT_NEAR(world->pose(1).position.y, 0.05f, 0.001f) << gravity;
    }
}

// Slopes steeper than friction holds, in weak gravity: slow, and not at rest.
TEST(Lengths, WhatSlidesDownASlopeSlidesOnInWeakGravity) {
    for (const float gravity : {0.01f, 0.1f, 1.0f}) {
        auto world = make_bullet_world(2);
        const float angle = 0.5f, steep = std::sin(angle) - 0.2f * std::cos(angle);
        world->set_gravity({gravity * std::sin(angle), -gravity * std::cos(angle), 0});  // the slope stands level
        const Vec3 p[] = {{-5, 0, -5}, {-5, 0, 5}, {50, 0, 5}, {50, 0, -5}};
        const std::array<uint32_t, 3> t[] = {{0, 1, 2}, {0, 2, 3}};
        world->add_static_triangles(0, p, t, 0.2f * 0.2f / 0.45f, 0, 1, ~0u);
        add_box(*world, 1, {0, 0.05f, 0}, {0.1f, 0.05f, 0.1f}, 1000);
        for (int frame = 0; frame < 600; ++frame) step(*world);
        EXPECT_NEAR(world->pose(1).position.x / (50 * gravity * steep), 1, 0.1) << gravity;
    }
}

}  // namespace
}  // namespace cullet
