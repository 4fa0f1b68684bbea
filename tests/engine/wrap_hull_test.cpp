#include "engine/bullet/wrap_hull.hpp"

#include <LinearMath/btConvexHullComputer.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/math.hpp"
#include "engine/random.hpp"
#include "sample_game/allocations.hpp"

namespace cullet::bullet {
namespace {

using Face = std::vector<uint32_t>;  // corners in order, the lowest first

Face from_lowest(Face corners) {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

Hull hull_of_points(const std::vector<Vec3>& points) {
    Hull hull;
    build_hull(hull, points, 0, 0);
    return hull;
}

/// Where the hull's points stand in the list that it was made of.
std::vector<uint32_t> sources(const Hull& hull, const std::vector<Vec3>& points) {
    std::vector<uint32_t> out;
    for (uint32_t k = 0; k < hull.point_count; ++k) {
        uint32_t nearest = 0;
        for (uint32_t i = 1; i < points.size(); ++i)
            if (length(points[i] - hull.local.centre - hull.local[k]) <
                length(points[nearest] - hull.local.centre - hull.local[k]))
                nearest = i;
        out.push_back(nearest);
    }
    return out;
}

std::set<Face> faces_of(const Hull& hull, const std::vector<Vec3>& points) {
    const std::vector<uint32_t> source = sources(hull, points);
    std::set<Face> out;
    for (uint32_t f = 0; f < hull.face_count; ++f) {
        Face face;
        for (uint32_t c = hull.first_corner[f]; c < hull.first_corner[f + 1]; ++c)
            face.push_back(source[hull.corner[c]]);
        out.insert(from_lowest(face));
    }
    return out;
}

std::set<Face> faces_of_bullet(const std::vector<Vec3>& points) {
    btConvexHullComputer computer;
    computer.compute(&points[0].x, sizeof(Vec3), static_cast<int>(points.size()), 0, 0);
    std::set<Face> out;
    for (int f = 0; f < computer.faces.size(); ++f) {
        Face face;
        const auto* const start = &computer.edges[computer.faces[f]];
        const auto* edge = start;
        do {
            face.push_back(static_cast<uint32_t>(computer.original_vertex_index[edge->getSourceVertex()]));
            edge = edge->getNextEdgeOfFace();
        } while (edge != start);
        out.insert(from_lowest(face));
    }
    return out;
}

struct Dice {
    Random random{1};
    uint64_t thrown = 0;
    float next(float low, float high) { return low + (high - low) * static_cast<float>(random.uniform(thrown++)); }
    float step(uint32_t steps) { return static_cast<float>(random.bits(thrown++) % (steps + 1)); }
};

constexpr uint32_t kGrid = 10216;  // steps of the width of either grid

/// Different places of a lattice whose box is all of the grid.
std::vector<Vec3> lattice_points(Dice& dice, uint32_t count, uint32_t steps) {
    const auto wide = static_cast<float>(kGrid / steps), end = static_cast<float>(kGrid);
    std::set<std::array<float, 3>> places{{0, 0, 0}, {end, end, end}};
    while (places.size() < count)
        places.insert({wide * dice.step(steps), wide * dice.step(steps), wide * dice.step(steps)});
    std::vector<Vec3> points;
    for (const auto& p : places) points.push_back({p[0], p[1], p[2]});
    return points;
}

// Where the points stand on both grids the hull is one and the same, faces of many corners included.
TEST(WrapHull, GivesTheFacesOfBulletsHullForPointsOnTheGrid) {
    Dice dice;
    for (const uint32_t steps : {2u, 4u, 8u, kGrid})
        for (uint32_t count = 4; count <= std::min(kMaxPoints, steps * steps * steps); ++count)
            for (int repeat = 0; repeat < 20; ++repeat) {
                const auto points = lattice_points(dice, count, steps);
                ASSERT_EQ(faces_of(hull_of_points(points), points), faces_of_bullet(points))
                    << count << " points of " << steps << " steps, throw " << dice.thrown;
            }
}

/// Shards of all proportions, turned anywhere: 1 cm to 30 cm long, 1 to 30 mm thick, many corners nearly in one plane.
std::vector<Vec3> shard(Dice& dice) {
    const Vec3 half{dice.next(0.005f, 0.15f), dice.next(0.005f, 0.15f), dice.next(0.0005f, 0.015f)};
    const Quat turn = normalised(Quat{dice.next(-1, 1), dice.next(-1, 1), dice.next(-1, 1), dice.next(-1, 1)});
    std::vector<Vec3> points;
    const auto count = 4 + static_cast<uint32_t>(dice.step(kMaxPoints - 4));
    for (uint32_t k = 0; k < count; ++k) {
        const float top = dice.next(0, 1) < 0.5f ? -1.0f : 1.0f;
        points.push_back(rotate(turn, {half.x * dice.next(-1, 1), half.y * dice.next(-1, 1), half.z * top}));
    }
    return points;
}

TEST(WrapHull, FacesCloseTheHullAndHoldAllPoints) {
    Dice dice;
    for (int run = 0; run < 5000; ++run) {
        const auto points = shard(dice);
        const Hull hull = hull_of_points(points);
        ASSERT_GE(hull.face_count, 4u) << run;
        EXPECT_EQ(hull.point_count + hull.face_count, hull.edge_count + 2) << run;  // Euler
        for (uint32_t e = 0; e < hull.edge_count; ++e) {
            const HullEdge edge = hull.edge[e];
            ASSERT_NE(edge.left, edge.right);
            // From a to b in the left face, from b to a in the right one.
            const auto follows = [&](uint8_t face, uint8_t from, uint8_t to) {
                const uint32_t first = hull.first_corner[face], end = hull.first_corner[face + 1];
                for (uint32_t c = first; c < end; ++c)
                    if (hull.corner[c] == from) return hull.corner[c + 1 == end ? first : c + 1] == to;
                return false;
            };
            EXPECT_TRUE(follows(edge.left, edge.a, edge.b) && follows(edge.right, edge.b, edge.a)) << run;
        }
        for (uint32_t f = 0; f < hull.face_count; ++f)
            for (const Vec3 p : points)
                EXPECT_LE(dot(hull.face_normal[f], p - hull.local.centre), hull.face_height[f] + 2e-4f * hull.radius)
                    << run;
        // Outwards: the mean of all corners lies below every face.
        Vec3 mean;
        for (uint32_t k = 0; k < hull.point_count; ++k)
            mean += (1 / static_cast<float>(hull.point_count)) * hull.local[k];
        for (uint32_t f = 0; f < hull.face_count; ++f)
            EXPECT_GT(hull.face_height[f] - dot(hull.face_normal[f], mean), -1e-4f * hull.radius) << run;
    }
}

TEST(WrapHull, APolygonHasTwoFacesALineNone) {
    const Hull square = hull_of_points({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5f, 0.5f, 1}});
    EXPECT_EQ(square.point_count, 4u);
    EXPECT_EQ(square.face_count, 2u);
    EXPECT_EQ(square.edge_count, 4u);
    EXPECT_EQ(square.face_normal[0].z, -square.face_normal[1].z);
    EXPECT_EQ(std::fabs(square.face_normal[0].z), 1.0f);
    const Hull triangle = hull_of_points({{0, 0, 0}, {1, 2, 3}, {3, 2, 2}});
    EXPECT_EQ(triangle.face_count, 2u);
    const Hull line = hull_of_points({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {3, 6, 9}});
    EXPECT_EQ(line.face_count, 0u);
    const Hull spot = hull_of_points({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
    EXPECT_EQ(spot.face_count, 0u);
}

TEST(WrapHull, EqualPointsAndThoseWithinAreLeftOut) {
    std::vector<Vec3> cube;
    for (int k = 0; k < 8; ++k)
        cube.push_back({static_cast<float>(k & 1), static_cast<float>(k >> 1 & 1), static_cast<float>(k >> 2 & 1)});
    auto points = cube;
    points.insert(points.end(), cube.begin(), cube.end());
    points.push_back({0.5f, 0.5f, 0.5f});
    points.push_back({0.5f, 0, 0});     // on an edge
    points.push_back({0.5f, 0.5f, 0});  // on a face
    const Hull hull = hull_of_points(points);
    EXPECT_EQ(hull.point_count, 8u);
    EXPECT_EQ(hull.face_count, 6u);
    EXPECT_EQ(hull.edge_count, 12u);
}

TEST(WrapHull, AsksForNoMemory) {
    Dice dice;
    const auto points = shard(dice);
    Hull hull;
    start_counting_allocations();
    build_hull(hull, points, 0.001f, 0);
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
}

}  // namespace
}  // namespace cullet::bullet
