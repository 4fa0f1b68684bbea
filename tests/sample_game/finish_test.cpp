// What materials look like: patterns belong to places of the cooked mesh, and turn into their average far away.
#include "sample_game/finish.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cullet {
namespace {

constexpr Finish kAll[] = {Finish::Plain,    Finish::Floor, Finish::Porcelain, Finish::Brick,
                           Finish::Concrete, Finish::Glass, Finish::Steel,     Finish::Aluminium,
                           Finish::Copper,   Finish::Wood,  Finish::Cloth,     Finish::Rubber};

FinishLook brick_at(float x, float y, float footprint, FaceKind kind = FaceKind::Outer) {
    return finish_at(Finish::Brick, {{x, y, 0}, {0, 0, 1}, footprint, kind}, {}, 0);
}

/// Grey against red: joints have more blue.
bool is_joint(const FinishLook& look) {
    return look.colour.z > 0.6f * look.colour.x;
}

TEST(Finish, EveryCompiledMaterialHasOneAndOthersArePlain) {
    EXPECT_EQ(finish_of("porcelain"), Finish::Porcelain);
    EXPECT_EQ(finish_of("glass"), Finish::Glass);
    EXPECT_EQ(finish_of("cloth"), Finish::Cloth);
    EXPECT_EQ(finish_of("marzipan"), Finish::Plain);
}

TEST(Finish, ColoursAreSharesOfLight) {
    for (const Finish finish : kAll)
        for (const FaceKind kind : {FaceKind::Outer, FaceKind::Inner, FaceKind::Crack})
            for (int i = 0; i < 2000; ++i) {
                const float t = static_cast<float>(i);
                const FinishPlace place{{0.0137f * t, 0.0071f * t, -0.0119f * t}, {0, 0, 1}, 0.0005f, kind};
                const FinishLook look = finish_at(finish, place, {0.4f, 0.4f, 0.4f}, 0.25f);
                for (const float channel : {look.colour.x, look.colour.y, look.colour.z}) {
                    EXPECT_GE(channel, 0);
                    EXPECT_LE(channel, 1);
                }
            }
}

TEST(Finish, BricksHaveTwelveCoursesAMetreAndJointsBetween) {
    int joints = 0;
    bool was_joint = is_joint(brick_at(0.11f, -0.0005f, 1e-4f));
    for (float y = 0; y < 1; y += 0.001f) {
        const bool is_one = is_joint(brick_at(0.11f, y, 1e-4f));
        joints += is_one && !was_joint;
        was_joint = is_one;
    }
    EXPECT_EQ(joints, 12);
}

TEST(Finish, BricksFarAwayAreOneColour) {
    const Vec3 here = brick_at(0.1f, 0.2f, 5).colour;
    for (float x = 0; x < 1; x += 0.07f) {
        const Vec3 there = brick_at(x, 0.6f * x, 5).colour;
        EXPECT_NEAR(there.x, here.x, 0.02f);
    }
}

// So that no brick sets its neighbour off where a footprint is as wide as some of them.
TEST(Finish, ABroadLookIsTheMeanOfManyNarrowOnes) {
    Vec3 sum{};
    for (int i = 0; i < 10'000; ++i)
        sum += 1e-4f * brick_at(0.0317f * static_cast<float>(i), 0.0071f * static_cast<float>(i), 1e-4f).colour;
    const Vec3 broad = brick_at(0.1f, 0.2f, 2).colour;
    EXPECT_NEAR(sum.x, broad.x, 0.15f * broad.x);
    EXPECT_NEAR(sum.z, broad.z, 0.25f * broad.z);
}

TEST(Finish, BrokenFacesShowTheInside) {
    for (const Finish finish : {Finish::Porcelain, Finish::Brick, Finish::Wood}) {
        const FinishPlace outside{{0.11f, 0.04f, 0}, {0, 0, 1}, 1e-3f, FaceKind::Outer};
        FinishPlace inside = outside;
        inside.kind = FaceKind::Crack;
        const FinishLook a = finish_at(finish, outside, {}, 0), b = finish_at(finish, inside, {}, 0);
        EXPECT_GT(length(a.colour - b.colour), 0.05f);
        EXPECT_EQ(b.gloss, 0);
    }
}

}  // namespace
}  // namespace cullet
