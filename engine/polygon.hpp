// Polygons, strips and fans of strangers, cut into triangles.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/math.hpp"
#include "engine/room.hpp"

namespace cullet {

/// The triangles of a polygon as numbers of its corners, in its own turning sense: one fewer than it has corners minus
/// one, so n - 2, whatever its shape. Convex ones become a fan, others lose ear after ear, seen along the normal of
/// their whole area. What has no such shape (crossing itself, no area, a corner that is not finite) becomes a fan.
/// Mostly O(n^2) for n corners; a comb of many teeth may cost O(n^3).
List<std::array<uint32_t, 3>> cut_polygon(std::span<const Vec3d> corners);

/// Which corners of a strip are those of its triangle t, in the turning sense of the first triangle.
constexpr std::array<size_t, 3> corners_in_strip(size_t t) {
    return {t, t + 1 + t % 2, t + 2 - t % 2};
}

/// The same of a fan, about its first corner, which stands last, as glTF has it.
constexpr std::array<size_t, 3> corners_in_fan(size_t t) {
    return {t + 1, t + 2, 0};
}

}  // namespace cullet
