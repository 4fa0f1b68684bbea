#pragma once
#include <span>

#include "engine/math.hpp"

namespace cullet {

/// Whether the segment between points a and b is an edge of the points' convex hull: seen along it, all others lie
/// within less than half a turn. Diagonals of flat faces are none. O(points).
bool is_hull_edge(std::span<const Vec3> points, size_t a, size_t b);

}  // namespace cullet
