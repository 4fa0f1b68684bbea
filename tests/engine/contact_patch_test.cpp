// Four contacts of the many that two hulls could have.
#include "engine/bullet/contact_patch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

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

}  // namespace
}  // namespace cullet::bullet
