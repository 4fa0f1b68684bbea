#include "engine/rigid_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <thread>

#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

TEST(RigidWorld, AFreeBodyFallsBySemiImplicitEuler) {
    auto world = make_bullet_world(16);
    world->set_gravity({0, -9.81f, 0});
    add_box(*world, 0, {0, 10, 0}, {0.1f, 0.1f, 0.1f}, 1000);
    double speed = 0, height = 10;
    for (int k = 0; k < 60; ++k) {
        step(*world);
        speed -= 9.81 * kStep;
        height += speed * kStep;
    }
    EXPECT_NEAR(world->pose(0).position.y, height, 1e-4);
    EXPECT_NEAR(world->motion(0).velocity.y, speed, 1e-4);
}

TEST(RigidWorld, ABoxRestsOnTheFloorWithinAMillimetre) {
    auto world = floor_world(16);
    add_box(*world, 1, {0, 0.2f, 0}, {0.1f, 0.05f, 0.08f}, 1000);
    for (int k = 0; k < 180; ++k) step(*world);
    EXPECT_NEAR(world->pose(1).position.y, 0.05f, 0.001f);
    EXPECT_TRUE(world->is_asleep(1));
}

TEST(RigidWorld, ABoxRestsOnATriangleFloorThatIsNoSolid) {
    auto world = make_bullet_world(16);
    world->set_gravity({0, -9.81f, 0});
    const Vec3 p[] = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    const std::array<uint32_t, 3> t[] = {{0, 1, 2}, {0, 2, 3}};
    world->add_static_triangles(0, p, t, 0.45f, 0.2f, 1, ~0u);
    add_box(*world, 1, {0, 0.2f, 0}, {0.1f, 0.05f, 0.08f}, 1000);
    for (int k = 0; k < 180; ++k) step(*world);
    EXPECT_NEAR(world->pose(1).position.y, 0.05f, 0.001f);
    EXPECT_TRUE(world->is_asleep(1));
}

TEST(RigidWorld, AStackOfFiveBoxesStands) {
    auto world = floor_world(16);
    for (uint32_t k = 0; k < 5; ++k)
        add_box(*world, 1 + k, {0, 0.05f + 0.101f * real(k), 0}, {0.05f, 0.05f, 0.05f}, 1000);
    for (int k = 0; k < 240; ++k) step(*world);
    for (uint32_t k = 0; k < 5; ++k) {
        EXPECT_NEAR(world->pose(1 + k).position.y, 0.05f + 0.1f * real(k), 0.002f);
        EXPECT_NEAR(world->pose(1 + k).position.x, 0, 0.002f);
        EXPECT_TRUE(world->is_asleep(1 + k));
    }
}

TEST(RigidWorld, ApproachSpeedLeavesOutThisStepsGravity) {
    auto world = floor_world(16);
    add_box(*world, 1, {0, 0.053f, 0}, {0.1f, 0.05f, 0.08f}, 1000);
    world->set_motion(1, {{0, -0.75f, 0}, {}});
    world->detect(kStep);
    ASSERT_EQ(world->contacts().size(), 4u);
    for (const RigidContact& c : world->contacts()) {
        EXPECT_EQ(c.a, 0u);
        EXPECT_EQ(c.b, 1u);
        EXPECT_NEAR(c.normal.y, -1, 1e-5f);  // from b, the box, towards a, the floor
        EXPECT_NEAR(c.distance, 0.003f, 1e-5f);
        EXPECT_NEAR(c.approach_speed, 0.75f, 1e-5f);
    }
    world->solve(kStep);
}

TEST(RigidWorld, PosesAndMotionsComeBackAsTheyWereSet) {
    auto world = make_bullet_world(4);
    RigidDescription d;
    const std::vector<Vec3> points = box_points({0.1f, 0.2f, 0.3f}, {0.5f, 0.1f, -0.2f});
    const ConvexPiece piece{points, 7};
    d.pieces = {&piece, 1};
    d.mass = 2;
    d.centre = {0.5, 0.1, -0.2};
    d.inertia = {0.3, 0.2, 0.4, 0.05, -0.02, 0.03};
    d.pose = {{1, 2, 3}, normalised(Quat{0.1f, -0.3f, 0.5f, 0.7f})};
    d.motion = {{1, -2, 3}, {4, 5, -6}};
    world->add(2, d);
    const auto expect_pose = [&] {
        const Pose pose = world->pose(2);
        EXPECT_NEAR(length(pose.position - d.pose.position), 0, 2e-6f);
        const Quat q = pose.orientation, r = d.pose.orientation;
        EXPECT_NEAR(std::fabs(q.x * r.x + q.y * r.y + q.z * r.z + q.w * r.w), 1, 1e-6f);
    };
    expect_pose();
    EXPECT_EQ(world->motion(2).velocity, d.motion.velocity);
    d.pose = {{-1, 0, 1}, normalised(Quat{0.4f, 0.3f, -0.5f, 0.1f})};
    world->set_pose(2, d.pose);
    expect_pose();
    // A new centre of mass: frame and pose stay, the velocity is that of the same rigid motion there.
    world->set_shape(2, 1, {0.6, 0.1, -0.2}, d.inertia, d.pieces);
    expect_pose();
    const Vec3 shift = rotate(d.pose.orientation, {0.1f, 0, 0});
    EXPECT_NEAR(length(world->motion(2).velocity - (d.motion.velocity + cross(d.motion.angular_velocity, shift))), 0,
                1e-5f);
}

// 3 rad/s about the middle axis, which is unstable, and 300 rad/s, 5 radians a step. The pose goes by steps about fixed
// axes: it is the direction that they cost.
TEST(RigidWorld, AFreeSpinKeepsEnergyAndAngularMomentumHoweverFast) {
    for (const float times : {1.0f, 100.0f}) {
        auto world = make_bullet_world(4);
        add_box(*world, 0, {0, 0, 0}, {0.1f, 0.2f, 0.3f}, 1000);
        world->set_motion(0, {{}, times * Vec3{0.1f, 3, 0.2f}});
        const Vec3 half{0.1f, 0.2f, 0.3f};
        const double m = 1000.0 * 8 * half.x * half.y * half.z;
        const Sym3d i{m / 3 * (half.y * half.y + half.z * half.z), m / 3 * (half.x * half.x + half.z * half.z),
                      m / 3 * (half.x * half.x + half.y * half.y)};
        const auto spin = [&] {
            return Vec3d(rotate(conjugate(world->pose(0).orientation), world->motion(0).angular_velocity));
        };
        const auto momentum = [&] { return rotate(world->pose(0).orientation, (i * spin()).to_float()); };
        const Vec3 before = momentum();
        const double energy = dot(spin(), i * spin());
        for (int k = 0; k < 60; ++k) step(*world);
        const Vec3 after = momentum();
        EXPECT_NEAR(length(after) / length(before), 1, 0.001);
        EXPECT_NEAR(dot(spin(), i * spin()) / energy, 1, 1e-4);
        // Poses turn by at most 45 degrees a step: beyond that the axis of the momentum is lost.
        if (times == 1) {
            EXPECT_GT(dot(normalised(after), normalised(before)), 0.998f);
        }
    }
}

TEST(RigidWorld, AKinematicBodyCarriesWhatLiesOnIt) {
    auto world = make_bullet_world(4);
    world->set_gravity({0, -9.81f, 0});
    add_box(*world, 0, {0, 0, 0}, {1, 0.1f, 1}, 1000, RigidKind::Kinematic);
    add_box(*world, 1, {0, 0.15f, 0}, {0.1f, 0.05f, 0.1f}, 1000);
    world->set_motion(0, {{0.3f, 0, 0}, {}});
    for (int k = 0; k < 120; ++k) step(*world);
    EXPECT_NEAR(world->pose(0).position.x, 0.6f, 1e-4f);
    EXPECT_NEAR(world->motion(1).velocity.x, 0.3f, 0.01f);
    EXPECT_NEAR(world->pose(1).position.y, 0.15f, 0.001f);
    world->set_motion(0, {});
    for (int k = 0; k < 120; ++k) step(*world);
    EXPECT_TRUE(world->is_asleep(1));
    world->set_motion(0, {{0, 0.5f, 0}, {}});
    step(*world);
    step(*world);
    EXPECT_FALSE(world->is_asleep(1));
}

TEST(RigidWorld, ARemovedSupportWakesWhatLayOnIt) {
    auto world = floor_world(8);
    add_box(*world, 1, {0, 0.05f, 0}, {0.2f, 0.05f, 0.2f}, 1000);
    add_box(*world, 2, {0, 0.15f, 0}, {0.1f, 0.05f, 0.1f}, 1000);
    for (int k = 0; k < 120; ++k) step(*world);
    ASSERT_TRUE(world->is_asleep(2));
    world->detect(kStep);
    world->remove(1);
    world->solve(kStep);
    for (int k = 0; k < 120; ++k) step(*world);
    EXPECT_NEAR(world->pose(2).position.y, 0.05f, 0.001f);
}

TEST(RigidWorld, WhatLiesInASleeperIsLiftedOutOfItByATenthOfAMillimetreAStep) {
    for (const bool is_asleep : {true, false}) {
        auto world = floor_world(8);
        add_box(*world, 1, {0, 0.05f, 0}, {0.2f, 0.05f, 0.2f}, 1000,
                is_asleep ? RigidKind::Dynamic : RigidKind::Static);
        for (int k = 0; k < 120; ++k) step(*world);
        ASSERT_EQ(world->is_asleep(1), is_asleep);
        add_box(*world, 2, {0, 0.1486f, 0}, {0.1f, 0.05f, 0.1f}, 1000);  // 1.4 mm in it
        float most = 0;
        for (int k = 0; k < 5; ++k) {
            const float before = world->pose(2).position.y;
            step(*world);
            most = std::max(most, world->pose(2).position.y - before);
        }
        EXPECT_EQ(world->is_asleep(1), is_asleep);
        if (is_asleep)
            EXPECT_LT(most, 0.00011f);
        else
            EXPECT_GT(most, 0.0002f);
        for (int k = 0; k < 60; ++k) step(*world);
        EXPECT_NEAR(world->pose(2).position.y, 0.15f, 0.001f);
    }
}

TEST(RigidWorld, SkippedContactsAreNotSolvedForOneStep) {
    auto world = floor_world(8);
    add_box(*world, 1, {0, 0.0505f, 0}, {0.2f, 0.05f, 0.2f}, 1000);
    world->set_motion(1, {{0, -1, 0}, {}});
    world->detect(kStep);
    ASSERT_FALSE(world->contacts().empty());
    world->skip_contacts(1, 0);
    world->solve(kStep);
    // Of its height of half a millimetre; what it did not fall of the step it has not earned.
    EXPECT_NEAR(world->motion(1).velocity.y, -1, 0.02f);
    step(*world);
    EXPECT_GT(world->motion(1).velocity.y, -0.1f);
}

TEST(RigidWorld, AnIgnoredPairMeetsAgainWhenTimeIsUp) {
    auto world = make_bullet_world(8);
    add_box(*world, 0, {0, 0, 0}, {0.1f, 0.1f, 0.1f}, 1000);
    add_box(*world, 1, {0, 0.15f, 0}, {0.1f, 0.1f, 0.1f}, 1000);  // 5 cm inside of each other
    world->ignore_pair(1, 0, 0.25f);
    for (int k = 0; k < 15; ++k) {
        world->detect(kStep);
        EXPECT_TRUE(world->contacts().empty()) << k;
        world->solve(kStep);
    }
    for (int k = 0; k < 3; ++k) step(*world);
    EXPECT_FALSE(world->contacts().empty());
}

/// Three boxes in one: two prongs that stand 5 cm apart, and what joins them above.
void add_fork(RigidWorld& world, RigidId id, Vec3 at) {
    RigidDescription d;
    const float m = d.margin;
    const Vec3 prong{0.03f - m, 0.1f - m, 0.1f - m};
    const std::vector<Vec3> left = box_points(prong, {-0.055f, 0, 0}), right = box_points(prong, {0.055f, 0, 0}),
                            bridge = box_points({0.085f - m, 0.03f - m, 0.1f - m}, {0, 0.13f, 0});
    const ConvexPiece pieces[] = {{left, 0}, {right, 1}, {bridge, 2}};
    d.pieces = pieces;
    d.mass = 6;
    d.centre = {0, 0.04, 0};
    d.inertia = {0.05, 0.05, 0.05};
    d.pose.position = at;
    world.add(id, d);
}

// Each prong pushes the box into the other one. It is turned a little, so that it is pushed up or down as well. A blow
// of 4 m/s, which would take it out of the prongs, takes both along; one of 20 m/s parts them.
TEST(RigidWorld, WhatIsWedgedComesToRestInItsPlaceAndOnlyAHardBlowPartsIt) {
    auto world = floor_world(16);
    add_fork(*world, 1, {0, 0.1f, 0});
    const Quat turned = normalised(Quat{0.02f, 0.03f, 0.05f, 1});
    add_box(*world, 2, {0, 0.05f, 0}, {0.035f, 0.045f, 0.15f}, 2000, RigidKind::Dynamic, turned);
    for (int k = 0; k < 300; ++k) step(*world);
    EXPECT_TRUE(world->is_asleep(1));
    EXPECT_TRUE(world->is_asleep(2));
    EXPECT_LT(length(world->pose(2).position - world->pose(1).position), 0.12f);
    EXPECT_GT(world->pose(2).position.y, 0.03f);
    const auto slid_after_blow = [&](float speed) {
        world->wake(2);
        world->set_motion(2, {{0, 0, speed}, {}});
        for (int k = 0; k < 30; ++k) step(*world);
        return world->pose(2).position.z - world->pose(1).position.z;
    };
    EXPECT_LT(slid_after_blow(4), 0.1f);
    EXPECT_GT(slid_after_blow(20), 0.26f);
}

// Two boxes in each other by a centimetre at their common crack, of which two places are given.
std::unique_ptr<RigidWorld> siblings(float speed_of_upper) {
    auto world = make_bullet_world(8);
    add_box(*world, 0, {0, 0, 0}, {0.1f, 0.1f, 0.1f}, 1000);
    add_box(*world, 1, {0, 0.19f, 0}, {0.1f, 0.1f, 0.1f}, 1000);
    const CrackTouch touches[] = {{{-0.09f, 0.095f, 0}, {0, -1, 0}, 0.1f}, {{0.09f, 0.095f, 0}, {0, -1, 0}, 0.1f}};
    world->part_siblings(0, 1, touches);
    world->set_motion(1, {{0, speed_of_upper, 0}, {}});
    world->solve(kStep);  // in the step of their birth they go as they were given to
    return world;
}

TEST(RigidWorld, SiblingsThatWereBornInEachOtherGoNoDeeperThereAndAreNotPushedApart) {
    auto world = siblings(-0.3f);
    const float depth = world->pose(0).position.y + 0.1f - (world->pose(1).position.y - 0.1f);
    EXPECT_NEAR(depth, 0.015f, 1e-5f);
    for (int k = 0; k < 8; ++k) step(*world);
    // As one body: half of the speed each, no bounce, and pushed out of each other by the 5 mm of the first step.
    EXPECT_NEAR(world->motion(0).velocity.y, -0.15f, 1e-4f);
    EXPECT_NEAR(world->motion(1).velocity.y, -0.15f, 1e-4f);
    EXPECT_NEAR(world->pose(1).position.y - world->pose(0).position.y, 0.19f, 0.002f);
}

TEST(RigidWorld, SiblingsThatPartAreLetGoAndMeetAgainAsAnyTwoOnceTheyAreApart) {
    auto world = siblings(1.2f);
    for (int k = 0; k < 3; ++k) step(*world);  // 2 cm a step
    EXPECT_EQ(world->motion(1).velocity.y, 1.2f);
    EXPECT_EQ(world->motion(0).velocity.y, 0);
    world->set_motion(1, {{0, -6, 0}, {}});
    for (int k = 0; k < 4; ++k) step(*world);
    EXPECT_NEAR(world->motion(0).velocity.y, world->motion(1).velocity.y, 1.3f);  // struck: a bounce of 0.2
    EXPECT_LT(world->motion(0).velocity.y, -2);
    EXPECT_GT(world->pose(1).position.y - world->pose(0).position.y, 0.197f);
}

TEST(RigidWorld, SiblingsWithoutTouchesPassForAQuarterOfASecondAtMost) {
    auto world = make_bullet_world(8);
    add_box(*world, 0, {0, 0, 0}, {0.1f, 0.1f, 0.1f}, 1000);
    add_box(*world, 1, {0, 0.15f, 0}, {0.1f, 0.1f, 0.1f}, 1000);
    world->part_siblings(0, 1, {});
    world->set_motion(1, {{0.01f, 0, 0}, {}});
    world->solve(kStep);
    for (int k = 0; k < 14; ++k) {
        world->detect(kStep);
        EXPECT_TRUE(world->contacts().empty()) << k;
        world->solve(kStep);
    }
    for (int k = 0; k < 3; ++k) step(*world);
    EXPECT_FALSE(world->contacts().empty());
}

// A bar that spins in its place strikes a box with its end.
struct AfterTheStroke {
    float apart, momentum, spin, deepest;  // m/s that the two fly apart, kg m/s, rad/s, m
};
AfterTheStroke stroke_of_a_spinning_bar(bool are_siblings) {
    auto world = make_bullet_world(8);
    add_box(*world, 0, {0, 0, 0}, {0.3f, 0.05f, 0.05f}, 1000);
    add_box(*world, 1, {0.25f, 0.16f, 0}, {0.1f, 0.05f, 0.05f}, 1000);
    const RigidId both[] = {0, 1};
    if (are_siblings) world->name_siblings(both);
    world->set_motion(0, {{}, {0, 0, 6}});
    float deepest = 0;
    for (int k = 0; k < 12; ++k) {
        step(*world);
        for (const RigidContact& contact : world->contacts()) deepest = std::min(deepest, contact.distance);
    }
    const Motion bar = world->motion(0), box = world->motion(1);
    const Vec3 momentum = 6 * bar.velocity + 2 * box.velocity;
    return {length(box.velocity - bar.velocity), length(momentum), length(bar.angular_velocity), deepest};
}

TEST(RigidWorld, SiblingsTakeFromEachOthersSpinAndDoNotThrowEachOther) {
    const AfterTheStroke siblings = stroke_of_a_spinning_bar(true), others = stroke_of_a_spinning_bar(false);
    EXPECT_GT(others.apart, 1);
    EXPECT_LT(siblings.apart, 1e-4f);
    EXPECT_LT(siblings.spin, 1);  // what it struck would else lie in its way
    EXPECT_LT(siblings.momentum, 1e-4f);
    EXPECT_GT(siblings.deepest, -0.001f);
}

// Both ways: what flies at its sibling is stopped without a bounce, and what slides along it is slowed down.
TEST(RigidWorld, SiblingsStopEachOthersFlightAndMeetAsAnyTwoAfterHalfASecond) {
    const auto struck = [](int steps_before) {
        auto world = make_bullet_world(8);
        add_box(*world, 0, {0, 0, 0}, {0.1f, 0.1f, 0.1f}, 1000);
        add_box(*world, 1, {0, 0.25f, 0}, {0.1f, 0.1f, 0.1f}, 1000);
        const RigidId both[] = {0, 1};
        world->name_siblings(both);
        for (int k = 0; k < steps_before; ++k) step(*world);
        world->set_motion(1, {{0.5f, -3, 0}, {}});
        for (int k = 0; k < 4; ++k) step(*world);
        return world->motion(0).velocity - world->motion(1).velocity;
    };
    const Vec3 young = struck(0), old = struck(31);
    EXPECT_NEAR(young.y, 0, 1e-3f);
    EXPECT_LT(std::fabs(young.x), 0.5f);
    EXPECT_LT(old.y, -0.3f);  // a bounce
}

// A body in mid-bounce on the floor beside another that it leans on; the first is held for `held` steps in the gap of
// step 12.
std::vector<Pose> bounce(int held) {
    auto world = floor_world(8);
    add_box(*world, 1, {0, 0.1f, 0}, {0.05f, 0.05f, 0.05f}, 1000, RigidKind::Dynamic,
            normalised(Quat{0.2f, 0.1f, 0.3f, 0.9f}));
    world->set_motion(1, {{0.5f, -1, 0.2f}, {3, 2, 1}});
    std::vector<Pose> poses;
    for (int k = 0; k < 60; ++k) {
        world->detect(kStep);
        if (held > 0 && k == 12) {
            world->hold(1);
            const Pose before = world->pose(1);
            for (int h = 0; h < held; ++h) {
                world->solve(kStep);
                EXPECT_TRUE(world->is_held(1));
                EXPECT_EQ(std::memcmp(&before, &poses.back(), sizeof(Pose)), 0);
                world->detect(kStep);
            }
            world->release(1);
        }
        world->solve(kStep);
        poses.push_back(world->pose(1));
    }
    return poses;
}

TEST(RigidWorld, AReleasedBodyGoesOnBitForBitAsIfNeverHeld) {
    const std::vector<Pose> never = bounce(0), once = bounce(1), long_time = bounce(6);
    for (size_t k = 0; k < never.size(); ++k) {
        EXPECT_EQ(std::memcmp(&never[k], &once[k], sizeof(Pose)), 0) << k;
        EXPECT_EQ(std::memcmp(&never[k], &long_time[k], sizeof(Pose)), 0) << k;
    }
}

TEST(RigidWorld, AHeldBodyIsAWallForOthers) {
    auto world = make_bullet_world(8);
    add_box(*world, 0, {0, 0, 0}, {0.1f, 0.1f, 0.1f}, 1);
    add_box(*world, 1, {0, 0.3f, 0}, {0.1f, 0.1f, 0.1f}, 8000);
    world->detect(kStep);
    world->hold(0);
    world->solve(kStep);
    world->set_motion(1, {{0, -2, 0}, {}});
    for (int k = 0; k < 20; ++k) step(*world);
    EXPECT_EQ(world->pose(0).position.y, 0);
    EXPECT_GT(world->pose(1).position.y, 0.199f);
    EXPECT_GT(world->motion(1).velocity.y, 0.2f);  // restitution 0.2 of 2 m/s
}

TEST(RigidWorld, BodiesMayBeAddedReshapedAndRemovedInTheGap) {
    auto world = floor_world(64);
    const std::vector<Vec3> small = box_points({0.02f, 0.02f, 0.02f}, {});
    const ConvexPiece piece{small, 0};
    for (uint32_t k = 0; k < 40; ++k) {
        world->detect(kStep);
        add_box(*world, 1 + k, {0.02f * real(k % 3), 0.05f + 0.01f * real(k), 0}, {0.05f, 0.05f, 0.05f}, 1000);
        if (k > 5) world->remove(k - 4);
        if (k > 3) world->set_shape(k, 0.064, {}, {1e-4, 1e-4, 1e-4}, {&piece, 1});
        world->solve(kStep);
    }
    for (int k = 0; k < 60; ++k) step(*world);
    SUCCEED();
}

TEST(RigidWorld, AThrownBallStopsAtAPlateOfFourMillimetres) {
    for (const float speed : {30.0f, 100.0f}) {
        for (int k = 0; k < 200; ++k) {
            auto world = make_bullet_world(8);
            add_plate(*world, 0);
            RigidDescription ball;
            ball.radius = 0.02f;
            ball.mass = 0.1;
            ball.inertia = {1.6e-5, 1.6e-5, 1.6e-5};
            const float across = 0.0007f * real(k), start = 0.1f + 0.0031f * real(k);
            ball.pose.position = {across, start, 0.4f * across};
            ball.motion.velocity = {0.01f * speed * real(k % 5 - 2), -speed, 0};
            world->add(1, ball);
            for (int s = 0; s < 60; ++s) step(*world);
            EXPECT_GT(world->pose(1).position.y, 0.0f) << speed << " m/s, try " << k;
        }
    }
}

// What happens after the touch is no matter here: a shard that lands on its edge whirls off sideways.
TEST(RigidWorld, ShardsAtAHundredMetresPerSecondTouchAPlateBeforeTheyPassIt) {
    for (int k = 0; k < 200; ++k) {
        auto world = make_bullet_world(8);
        add_plate(*world, 0);
        const Quat q = normalised(Quat{0.1f * real(k % 7) - 0.3f, 0.3f, 0.1f * real(k % 11) - 0.5f, 0.4f});
        add_shard(*world, 1, {0.001f * real(k) - 0.1f, 0.2f + 0.0031f * real(k), 0}, q);
        world->set_motion(1, {{0, -100, 0}, {5.0f * real(k % 3), 0, 10}});
        float approach = 0, distance = 1;
        for (int s = 0; s < 5 && approach == 0; ++s) {
            world->detect(kStep);
            for (const RigidContact& c : world->contacts()) {
                approach = std::max(approach, c.approach_speed);
                distance = std::min(distance, c.distance);
            }
            world->solve(kStep);
        }
        EXPECT_GE(world->counts().sweeps, 1u) << k;
        EXPECT_GT(approach, 50) << k;
        EXPECT_GT(distance, 0) << k;
        EXPECT_LT(distance, 0.0006f) << k;
    }
}

std::vector<Pose> pile_poses(uint32_t shards, int steps) {
    auto world = floor_world(shards + 8);
    drop_shards(*world, 1, shards);
    for (int k = 0; k < steps; ++k) step(*world);
    std::vector<Pose> poses;
    for (uint32_t k = 0; k < shards; ++k) poses.push_back(world->pose(1 + k));
    return poses;
}

TEST(RigidWorld, TheSameCallsGiveTheSameBitsAloneAndOnTwoThreads) {
    const std::vector<Pose> once = pile_poses(20, 90), again = pile_poses(20, 90);
    std::vector<Pose> left, right;
    std::thread other([&] { left = pile_poses(20, 90); });
    right = pile_poses(20, 90);
    other.join();
    EXPECT_EQ(std::memcmp(once.data(), again.data(), once.size() * sizeof(Pose)), 0);
    EXPECT_EQ(std::memcmp(once.data(), left.data(), once.size() * sizeof(Pose)), 0);
    EXPECT_EQ(std::memcmp(once.data(), right.data(), once.size() * sizeof(Pose)), 0);
}

double kinetic_energy(const RigidWorld& world, RigidId id, const ShardShape& shape) {
    const Motion m = world.motion(id);
    const Vec3d v(m.velocity), w(rotate(conjugate(world.pose(id).orientation), m.angular_velocity));
    return 0.5 * shape.mass * dot(v, v) + 0.5 * dot(w, shape.inertia * w);
}

TEST(RigidWorld, CollidingShardsKeepTheirMomentumAndNeverGainEnergy) {
    constexpr uint32_t kShards = 6;
    auto world = make_bullet_world(16);
    for (uint32_t k = 0; k < kShards; ++k) {
        double sine, cosine;
        sine_cosine(1.0471976 * k, sine, cosine);
        const auto x = static_cast<float>(0.3 * cosine), z = static_cast<float>(0.3 * sine);
        add_shard(*world, 1 + k, {x, 0.02f * real(k), z}, normalised(Quat{0.1f * real(k), 0.3f, 0.2f, 1}));
        world->set_motion(1 + k, {{-8 * x, 0, -8 * z + 0.1f}, {3, real(k), 0}});
    }
    const auto sums = [&](double& energy) {
        Vec3d momentum;
        energy = 0;
        for (RigidId id = 1; id <= kShards; ++id) {
            momentum += test_shard().mass * Vec3d(world->motion(id).velocity);
            energy += kinetic_energy(*world, id, test_shard());
        }
        return momentum;
    };
    double energy = 0;
    const Vec3d start = sums(energy);
    const double first = energy;
    for (int k = 0; k < 120; ++k) {
        step(*world);
        double now = 0;
        EXPECT_LT(length(sums(now) - start), 1e-5 * kShards * test_shard().mass * 2.4);
        EXPECT_LT(now, energy + 1e-4 * first) << k;
        energy = now;
    }
    EXPECT_LT(energy, 0.9 * first);
    EXPECT_EQ(length(world->impulse_to_static()), 0);
}

TEST(RigidWorld, WhatTheFloorReceivedIsWhatTheShardsLost) {
    constexpr uint32_t kShards = 8;
    auto world = floor_world(16);
    drop_shards(*world, 1, kShards);
    Vec3d weight;
    for (int k = 0; k < 50; ++k) {
        for (RigidId id = 1; id <= kShards; ++id) {
            ASSERT_FALSE(world->is_asleep(id));
            weight += Vec3d{0, -9.81 * test_shard().mass / 60, 0};
        }
        step(*world);
    }
    Vec3d momentum;
    for (RigidId id = 1; id <= kShards; ++id) momentum += test_shard().mass * Vec3d(world->motion(id).velocity);
    const Vec3d given = world->impulse_to_static();
    EXPECT_LT(length(weight - momentum - given), 1e-5 * length(weight));
    EXPECT_LT(given.y, -0.5 * length(weight));
}

}  // namespace
}  // namespace cullet
