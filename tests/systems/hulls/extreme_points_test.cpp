#include "systems/hulls/extreme_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "engine/scratch.hpp"
#include "tests/support/hull_gap.hpp"

namespace cullet {
namespace {

/// A part of a bent wall: two layers of points over a fan, an arc or a band of a cylinder.
std::vector<Vec3> bent_wall(std::mt19937& engine) {
    const auto between = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(engine);
    };
    const float radius = between(0.02f, 0.3f), wall = radius * between(0.02f, 0.2f), turn = between(0.2f, 2),
                high = between(0, 0.5f) * radius;
    const int around = 3 + static_cast<int>(engine() % 6);
    std::vector<Vec3> points;
    const auto add = [&](float r, float angle, float y) {
        points.push_back({r * std::cos(angle), y, r * std::sin(angle)});
        points.push_back({0.99f * r * std::cos(angle), y + wall, 0.99f * r * std::sin(angle)});
    };
    for (int k = 0; k <= around; ++k) add(radius, turn * static_cast<float>(k) / static_cast<float>(around), 0);
    for (int k = 0; k <= around && high > 0.1f * radius; ++k)
        add(radius, turn * static_cast<float>(k) / static_cast<float>(around), high);
    if (engine() % 2) add(0.01f * radius, 0, 0);
    return points;
}

// What lies past a sharp edge is near both of its faces, and far from one that comes later.
TEST(ExtremePoints, WhatIsLeftOutLiesNoFartherFromTheHullThanIsSaid) {
    const auto scratch = std::make_unique<ScratchMemory>();
    for (uint32_t seed = 0; seed < 300; ++seed) {
        std::mt19937 engine(seed);
        const std::vector<Vec3> points = bent_wall(engine);
        const float enough = 0.002f * length(points[0]);
        const uint32_t most = seed % 3 == 0 ? 10 : kMostHullPoints;
        const auto chosen = std::make_unique<ExtremePoints>();
        choose_extremes(*scratch, points, most, enough, *chosen);
        ASSERT_LE(chosen->count, most);
        std::vector<Vec3d> corners;
        for (uint32_t k = 0; k < chosen->count; ++k) corners.push_back(Vec3d(points[chosen->index[k]]));
        const HullFaces hull = hull_faces(corners);
        double worst = 0;
        for (const Vec3 p : points) worst = std::max(worst, hull_gap(hull, Vec3d(p)));
        // Along a normal that is the greatest height, and at an edge between two faces less than twice that.
        EXPECT_LE(worst, 2.1 * double{std::max(enough, chosen->left_out)}) << "seed " << seed;
    }
}

}  // namespace
}  // namespace cullet
