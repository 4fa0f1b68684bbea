// Boxes by their own short way, beside the same hulls by the way of all hulls.
#include "engine/bullet/box_patch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/random.hpp"

namespace cullet::bullet {
namespace {

struct Dice {
    Random random{11};
    uint64_t thrown = 0;
    float next(float low, float high) { return low + (high - low) * static_cast<float>(random.uniform(thrown++)); }
};

Hull make_box(Vec3 half, float margin) {
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k)
        points.push_back({k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z});
    Hull hull;
    build_hull(hull, points, margin, 0);
    return hull;
}

std::vector<float> distances(const Patch& patch) {
    std::vector<float> out;
    for (int k = 0; k < patch.count; ++k) out.push_back(patch.point[k].distance);
    std::sort(out.begin(), out.end());
    return out;
}

/// How far a point is from the hull's core, a box.
float distance_from(const Hull& hull, const Mat3& rotation, Vec3 point) {
    const Vec3 from = transposed_times(rotation, point - hull.world.centre);
    float square = 0;
    for (int k = 0; k < 3; ++k) {
        const float out = std::max(std::fabs(dot(from, hull.box_axis[k])) - hull.box_half[k], 0.0f);
        square += out * out;
    }
    return std::sqrt(square);
}

TEST(BoxPatch, ABoxIsKnownByItsPointsAndNothingElseIsOne) {
    Hull box = make_box({0.1f, 0.02f, 0.05f}, 0.001f);
    EXPECT_TRUE(box.is_box);
    turn_hull(box, matrix(normalised(Quat{0.1f, 0.5f, -0.3f, 0.6f})), {1, 2, 3}, 0.002f, 0);
    EXPECT_TRUE(box.is_box);
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k)  // a blunt wedge
        points.push_back({k & 1 ? 0.1f : -0.1f, (k & 2 ? 0.1f : -0.1f) * (k & 1 ? 0.9f : 1), k & 4 ? 0.1f : -0.1f});
    Hull other;
    build_hull(other, points, 0.001f, 0);
    EXPECT_EQ(other.face_count, 6u);
    EXPECT_FALSE(other.is_box);
    points.pop_back();
    build_hull(box, points, 0.001f, 0);  // where a box was
    EXPECT_FALSE(box.is_box);
}

TEST(BoxPatch, FindsTheContactThatAnyTwoHullsOfTheSamePointsHave) {
    Dice dice;
    uint32_t taken = 0, touching = 0;
    for (int round = 0; round < 20000; ++round) {
        const Vec3 half_a{dice.next(0.01f, 0.2f), dice.next(0.01f, 0.2f), dice.next(0.01f, 0.2f)},
            half_b{dice.next(0.01f, 0.2f), dice.next(0.01f, 0.2f), dice.next(0.01f, 0.2f)};
        const float margin = round % 2 ? 0.001f : 0.03f;
        Hull a = make_box(half_a, margin), b = make_box(half_b, margin);
        // Half of them lie nearly flat on each other.
        const float tilt = round % 4 < 2 ? 0.01f : 1;
        const Quat turn_a = normalised(Quat{dice.next(-1, 1), dice.next(-1, 1), dice.next(-1, 1), 1});
        const Quat turn_b =
            normalised(turn_a * Quat{dice.next(-tilt, tilt), dice.next(-1, 1), dice.next(-tilt, tilt), 1});
        const Mat3 rotation_a = matrix(turn_a), rotation_b = matrix(turn_b);
        const Vec3 at =
            rotation_a * Vec3{dice.next(-0.2f, 0.2f), half_a.y + half_b.y + 2 * margin + dice.next(-0.001f, 0.008f),
                              dice.next(-0.2f, 0.2f)};
        refresh_world(a, rotation_a, {});
        refresh_world(b, rotation_b, at);
        Patch quick;
        Vec3 quick_guess, guess;
        if (!box_patch(a, rotation_a, b, rotation_b, quick_guess, quick)) continue;
        ++taken;
        a.is_box = false;
        const Patch slow = contact_patch(a, rotation_a, b, rotation_b, guess, true);
        if (quick.count == 0) {
            for (const float distance : distances(slow)) EXPECT_GT(distance, kContactRange - 1e-5f) << round;
            // A bound, from below.
            const float gap = separation(a, b, guess, 1);
            EXPECT_LT(quick.room, gap - kContactRange + 1e-5f) << round;
            continue;
        }
        ++touching;
        ASSERT_GT(slow.count, 0) << round;
        // Between faces that are nearly parallel any direction between their normals will do.
        EXPECT_GT(dot(quick.normal, slow.normal), 0.9998f) << round;
        EXPECT_NEAR(distances(quick)[0], distances(slow)[0], 2e-5f) << round;
        // On the surfaces; the margin counts along the normal, so that on a tilted face it is short by its cosine.
        const float near = tilt < 1 ? 2e-4f : margin;
        for (int k = 0; k < quick.count; ++k) {
            const float from_a = distance_from(a, rotation_a, quick.point[k].on_a),
                        from_b = distance_from(b, rotation_b, quick.point[k].on_b);
            EXPECT_LT(std::max(from_a, from_b), margin + 2e-4f) << round;
            EXPECT_GT(std::min(from_a, from_b), margin - near) << round;
        }
    }
    EXPECT_GT(taken, 5000u);
    EXPECT_GT(touching, 2000u);
}

}  // namespace
}  // namespace cullet::bullet
