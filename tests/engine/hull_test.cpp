// Hulls seen in other axes are the hulls of the points seen in those axes.
#include "engine/bullet/hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/random.hpp"
#include "tests/engine/rigid_scenes.hpp"

namespace cullet::bullet {
namespace {

constexpr float kNear = 2e-6f;  // of points about a metre from the origin

struct Dice {
    Random random{3};
    uint64_t thrown = 0;
    float next() { return 2 * static_cast<float>(random.uniform(thrown++)) - 1; }
    Vec3 place() { return {next(), next(), next()}; }
};

void expect_near(Vec3 a, Vec3 b) {
    EXPECT_LT(length(a - b), kNear);
}

/// All but the world columns.
void expect_same(const Hull& a, const Hull& b) {
    ASSERT_EQ(a.point_count, b.point_count);
    ASSERT_EQ(a.face_count, b.face_count);
    ASSERT_EQ(a.edge_count, b.edge_count);
    EXPECT_EQ(a.cell, b.cell);
    EXPECT_EQ(a.margin, b.margin);
    EXPECT_NEAR(a.radius, b.radius, kNear);
    EXPECT_NEAR(a.thickness, b.thickness, kNear);
    expect_near(a.local.centre, b.local.centre);
    expect_near(a.local_box.low, b.local_box.low);
    expect_near(a.local_box.high, b.local_box.high);
    for (uint32_t k = 0; k < a.local.count; ++k) expect_near(a.local[k], b.local[k]);
    for (uint32_t f = 0; f < a.face_count; ++f) {
        EXPECT_LT(length(a.face_normal[f] - b.face_normal[f]), kNear);
        EXPECT_NEAR(a.face_height[f], b.face_height[f], kNear);
        // What a face bounds lies behind it.
        for (uint32_t k = 0; k < a.local.count; ++k)
            EXPECT_LT(dot(a.face_normal[f], a.local[k]), a.face_height[f] + kNear);
    }
}

TEST(Hull, TurnedWhereItStandsOrCopiedItIsTheHullOfTheTurnedPoints) {
    Dice dice;
    constexpr float kMargin = 0.003f;
    for (int round = 0; round < 200; ++round) {
        std::vector<Vec3> points;
        for (int k = 0; k < 4 + round % 20; ++k) points.push_back(normalised(dice.place()));
        Hull made;
        build_hull(made, points, 0, 7);
        const Vec3 origin = dice.place();
        const Mat3 turn = matrix(normalised(Quat{dice.next(), dice.next(), dice.next(), 1.1f + dice.next()}));
        std::vector<Vec3> moved;
        for (uint32_t k = 0; k < made.point_count; ++k)
            moved.push_back(turn * (made.local.centre + made.local[k] - origin));
        Hull expected;
        build_hull_like(expected, made, turn, moved, kMargin, 9);
        Hull turned = made;
        turn_hull(turned, turn, origin, kMargin, 9);
        expect_same(turned, expected);
        Hull anew;
        build_hull(anew, moved, kMargin, 9);
        ASSERT_EQ(anew.point_count, turned.point_count);
        EXPECT_NEAR(anew.radius, turned.radius, kNear);
        EXPECT_NEAR(anew.thickness, turned.thickness, 2e-4f);  // the grid of wrap_hull() turns, too
    }
}

TEST(Hull, OfTwoPiecesSideBySideTheFacesBetweenThemAreInner) {
    const auto block = [](Vec3 at) {
        std::vector<Vec3> points;
        for (int k = 0; k < 8; ++k)
            points.push_back(at + 0.5f * Vec3{k & 1 ? 1.0f : 0, k & 2 ? 1.0f : 0, k & 4 ? 1.0f : 0});
        return points;
    };
    Hull left, right, above;
    build_hull(left, block({}), 0.001f, 0);
    build_hull(right, block({0.502f, 0, 0}), 0.001f, 1);
    build_hull(above, block({0, 0.51f, 0}), 0.001f, 2);  // a gap between: no seam
    for (Hull* hull : {&left, &right, &above})
        for (const Hull* other : {&left, &right, &above}) mark_covered(*hull, *other);
    const auto inner_of = [](const Hull& hull) {
        std::vector<Vec3> out;
        for (uint32_t f = 0; f < hull.face_count; ++f)
            if (hull.is_face_inner[f]) out.push_back(hull.face_normal[f]);
        return out;
    };
    ASSERT_EQ(inner_of(left).size(), 1u);
    EXPECT_GT(inner_of(left)[0].x, 0.999f);
    ASSERT_EQ(inner_of(right).size(), 1u);
    EXPECT_LT(inner_of(right)[0].x, -0.999f);
    EXPECT_TRUE(inner_of(above).empty());
}

TEST(Hull, TheRiserOfAStepIsInnerInItsMiddleAloneWhenTheStepBeforeStandsOnTheSameGround) {
    for (const float low : {0.3f, 0.98f, 1.0f}) {
        Hull before, step;
        build_hull(before, box_points({0.5f, 0.5f * low, 0.5f}, {-0.502f, 0.5f * low, 0}), 0.001f, 0);
        build_hull(step, box_points({0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0}), 0.001f, 1);
        const auto expect_inner = [&](bool is_whole, bool is_inner) {
            Hull hull = step;
            mark_covered(hull, before, is_whole);
            EXPECT_EQ(std::count(hull.is_face_inner, hull.is_face_inner + hull.face_count, true), is_inner) << low;
            EXPECT_NE(std::count(hull.covered, hull.covered + hull.face_count, 0u), hull.face_count) << low;
        };
        expect_inner(false, low > 0.5f);
        expect_inner(true, low == 1.0f);
    }
}

// Beside a wide tile stand narrow ones, so that no one of them covers its side.
TEST(Hull, AFaceThatSeveralPiecesCoverTogetherIsInner) {
    for (const uint32_t count : {2u, 3u, 4u, 5u, 7u})
        for (uint32_t missing = 0; missing <= count; ++missing) {
            Hull wide;
            build_hull(wide, box_points({0.5f, 0.1f, 0.5f}, {}), 0.001f, 0);
            const float half = 0.5f / static_cast<float>(count);
            for (uint32_t k = 0; k < count; ++k) {
                Hull narrow;
                const float z = half * (2 * static_cast<float>(k) + 1) - 0.5f;
                build_hull(narrow, box_points({0.2f, 0.1f, half - 0.001f}, {0.702f, 0, z}), 0.001f, k + 1);
                if (k != missing) mark_covered(wide, narrow, true);
            }
            const auto inner = std::count(wide.is_face_inner, wide.is_face_inner + wide.face_count, true);
            const bool is_seen = count <= 3 || missing == 0 || missing + 1 == count || 2 * missing + 1 == count;
            if (missing == count || is_seen) {
                EXPECT_EQ(inner, missing == count) << missing << " of " << count;
            }
        }
}

}  // namespace
}  // namespace cullet::bullet
