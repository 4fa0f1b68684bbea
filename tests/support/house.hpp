// One small house in many formats: 9 points, 14 triangles, one closed part, 1 x 2.5 x 3 m from the origin, y up, 6.5
// m3. It has no symmetry: whoever mirrors it, lays it on a side or loses a digit of its size is found out.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/math.hpp"
#include "engine/mesh.hpp"

namespace cullet::test {

inline const std::vector<Vec3d>& house_points() {
    static const std::vector<Vec3d> points{{0, 0, 0}, {1, 0, 0}, {1, 0, 3}, {0, 0, 3},     {0, 2, 0},
                                           {1, 2, 0}, {1, 2, 3}, {0, 2, 3}, {0.25, 2.5, 1}};
    return points;
}

inline const std::vector<std::array<int, 3>>& house_triangles() {
    static const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 1}, {1, 5, 6},
                                                           {1, 6, 2}, {2, 6, 7}, {2, 7, 3}, {3, 7, 4}, {3, 4, 0},
                                                           {4, 7, 8}, {7, 6, 8}, {6, 5, 8}, {5, 4, 8}};
    return triangles;
}

/// The same triangles as strips, each as far as the next -1.
inline const std::vector<int>& house_strips() {
    static const std::vector<int> strips{0, 1, 3, 2, -1, 0, 4, 1, 5,  -1, 1, 5, 2,  6, -1, 2, 6,  3, 7, -1,
                                         3, 7, 0, 4, -1, 4, 7, 8, -1, 7,  6, 8, -1, 6, 5,  8, -1, 5, 4, 8};
    return strips;
}

/// The number of the house's point there; -1 when it has none.
inline int house_point_at(Vec3 p, double tolerance) {
    for (size_t i = 0; i < house_points().size(); ++i)
        if (length(Vec3d(p) - house_points()[i]) <= tolerance) return static_cast<int>(i);
    return -1;
}

inline double volume_of(const Mesh& mesh) {
    double six_volumes = 0;
    for (const auto& t : mesh.triangles)
        six_volumes +=
            dot(Vec3d(mesh.positions[t[0]]), cross(Vec3d(mesh.positions[t[1]]), Vec3d(mesh.positions[t[2]])));
    return six_volumes / 6;
}

/// All points where they belong, to a few millionths; flat walls may be cut along either diagonal.
inline void expect_house(const Mesh& mesh, const std::string& what) {
    EXPECT_EQ(mesh.positions.size(), 9u) << what;
    EXPECT_EQ(mesh.triangles.size(), 14u) << what;
    EXPECT_NEAR(volume_of(mesh), 6.5, 1e-4) << what;
    std::vector<int> found;
    for (const Vec3 p : mesh.positions) found.push_back(house_point_at(p, 1e-5));
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8})) << what;
}

}  // namespace cullet::test
