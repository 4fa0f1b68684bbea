// Polygons of strangers, cut into triangles.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/math.hpp"

namespace cullet {

/// The triangles of a polygon as numbers of its corners, in its own turning sense: one fewer than it has corners minus
/// one, so n - 2, whatever its shape. Convex ones become a fan, others lose ear after ear, seen along the normal of
/// their whole area. What has no such shape (crossing itself, no area, a corner that is not finite) becomes a fan.
/// Mostly O(n^2) for n corners; a comb of many teeth may cost O(n^3).
std::vector<std::array<uint32_t, 3>> cut_polygon(std::span<const Vec3d> corners);

}  // namespace cullet
