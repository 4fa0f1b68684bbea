// Four contacts of the many that two hulls could have.
#include "engine/bullet/contact_patch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/bullet/closest_points.hpp"
#include "engine/random.hpp"

namespace cullet::bullet {
namespace {

struct Dice {
    Random random{5};
    uint64_t thrown = 0;
    float next(float low, float high) { return low + (high - low) * static_cast<float>(random.uniform(thrown++)); }
};

/// The piece of a wall: an outline of ten corners, and two or three low points at each end, all within 3 mm in height.
std::vector<Vec3> bent_slab(Dice& dice, float half_length) {
    std::vector<Vec3> points;
    constexpr Vec3 kOutline[] = {{1, 0, 0.3f},       {0.9f, 0, -0.4f},  {0.6f, 0, 0.6f},
                                 {0, 0, 0.65f},      {-0.5f, 0, 0.6f},  {-1, 0, 0.2f},
                                 {-0.95f, 0, -0.4f}, {-0.3f, 0, -0.6f}, {0.4f, 0, -0.6f}};
    for (const Vec3 at : kOutline)
        for (const float side : {1.0f, -1.0f})
            points.push_back({half_length * (at.x + dice.next(-0.05f, 0.05f)), side * 0.1f + dice.next(-0.01f, 0.01f),
                              half_length * (at.z + dice.next(-0.05f, 0.05f))});
    for (const float end : {1.0f, -1.0f})
        for (int k = 0; k < 3; ++k)
            points.push_back({end * half_length * dice.next(0.6f, 1), -0.125f - dice.next(0, 0.003f),
                              half_length * dice.next(-0.3f, 0.3f)});
    return points;
}

// With contacts at one end alone it rocks to the other, and back in the next step.
TEST(ContactPatch, ASlabThatStandsDeepInAFloorWithBothEndsHasContactsAtBoth) {
    Dice dice;
    constexpr float kMargin = 0.001f, kFloor = 0.5f;
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k)
        corners.push_back({k & 1 ? 20.0f : -20.0f, k & 2 ? kFloor : -kFloor, k & 4 ? 20.0f : -20.0f});
    Hull floor;
    build_hull(floor, corners, 0, 0);
    for (int round = 0; round < 2000; ++round) {
        const float half_length = dice.next(0.3f, 1.2f);
        Hull slab;
        build_hull(slab, bent_slab(dice, half_length), kMargin, 0);
        // The higher end's points stay a millimetre deep at the least.
        const float tilt = dice.next(-0.003f, 0.003f) / half_length;
        const Quat turn = normalised(Quat{0, dice.next(-1, 1), 0, 1}) * normalised(Quat{0, 0, 0.5f * tilt, 1});
        const Mat3 rotation = matrix(turn), still = matrix(Quat{0, 0, 0, 1});
        const Vec3 at{dice.next(-5, 5), kFloor + 0.125f - dice.next(0.01f, 0.02f), dice.next(-5, 5)};
        refresh_world(floor, still, {});
        refresh_world(slab, rotation, at);
        Vec3 guess;
        const Patch patch = contact_patch(floor, still, slab, rotation, guess, true);
        float low = 1, high = -1;
        for (int k = 0; k < patch.count; ++k) {
            const float along = transposed_times(rotation, patch.point[k].on_b - at).x / half_length;
            low = std::min(low, along), high = std::max(high, along);
        }
        EXPECT_LT(low, -0.2f) << round;
        EXPECT_GT(high, 0.2f) << round;
    }
}

/// m that a place lies above the nearest plane of a hull with its margin; negative inside.
float height_over(const Hull& hull, const Mat3& rotation, Vec3 at, Vec3 place) {
    const Vec3 local = transposed_times(rotation, place - at) - hull.local.centre;
    float most = -1;
    for (uint32_t f = 0; f < hull.face_count; ++f)
        most = std::max(most, dot(hull.face_normal[f], local) - hull.face_height[f] - hull.margin);
    return most;
}

// Points of a patch along a slant normal lie on a prism's side, 1.6 mm below the rim that is touched. An edge inside of
// what is flat was taken for a side, and threw a shard up by 56 mm.
TEST(ContactPatch, TheNearestPlacesAreOnBothPiecesAndAsFarApartAsNoPointIsNearer) {
    Dice dice;
    constexpr float kMargin = 0.001f, kRounding = 3e-6f;
    uint32_t met = 0, slant = 0;
    for (int round = 0; round < 4000; ++round) {
        // A triangle's prism below y = 0, and a bent slab over it or past its rim.
        std::vector<Vec3> prism;
        const float wide = dice.next(0.05f, 0.2f), deep = dice.next(0.03f, 0.2f);
        for (const Vec3 at :
             {Vec3{-wide, 0, 0}, Vec3{wide, 0, dice.next(-0.05f, 0)}, Vec3{dice.next(-wide, wide), 0, wide}})
            for (const float y : {-kMargin, -deep}) prism.push_back({at.x, y, at.z});
        Hull below, slab;
        build_hull(below, prism, kMargin, 0);
        build_hull(slab, bent_slab(dice, 0.1f), kMargin, 0);
        const Quat turn = normalised(Quat{dice.next(-1, 1), dice.next(-1, 1), dice.next(-1, 1), dice.next(-1, 1)});
        const Mat3 rotation = matrix(turn), still = matrix(Quat{0, 0, 0, 1});
        const Vec3 at{dice.next(-0.2f, 0.2f), dice.next(0.05f, 0.2f), dice.next(-0.2f, 0.3f)};
        refresh_world(below, still, {});
        refresh_world(slab, rotation, at);
        Vec3 guess;
        const Patch patch = contact_patch(below, still, slab, rotation, guess, true);
        if (!patch.has_nearest) continue;
        ++met, slant += std::fabs(patch.normal.y) < 0.99f;
        const Vec3 way = patch.nearest_on_a - patch.nearest_on_b;
        const float distance = dot(way, patch.normal);
        EXPECT_LT(length(way - distance * patch.normal), kRounding) << round;
        EXPECT_LT(height_over(below, still, {}, patch.nearest_on_a), kRounding) << round;
        EXPECT_LT(height_over(slab, rotation, at, patch.nearest_on_b), kRounding) << round;
        EXPECT_NEAR(distance, gap_along(below.world, slab.world, Vec3d(patch.normal)) - 2 * kMargin, kRounding)
            << round;
    }
    EXPECT_GT(met, 50u);
    EXPECT_GT(slant, 20u);
}

}  // namespace
}  // namespace cullet::bullet
