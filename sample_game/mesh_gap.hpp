// Distances between triangles, in double and without shortcuts: what the figures about rest are made of.
#pragma once
#include <array>

#include "engine/math.hpp"

namespace cullet {

using Corners = std::array<Vec3d, 3>;

/// From a point to the nearest point of a triangle, m. A flat triangle counts as its sides.
double point_gap(Vec3d point, const Corners& triangle);
/// Between the nearest points of two triangles, m; 0 where they cut each other.
double triangle_gap(const Corners& a, const Corners& b);

}  // namespace cullet
