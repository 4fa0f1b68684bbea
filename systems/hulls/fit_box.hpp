// The tightest box about few points, and the volume of their hull, in double.
#pragma once
#include <algorithm>
#include <span>

#include "systems/hulls/extreme_points.hpp"

namespace cullet {

struct FittedBox {
    Vec3d axis[3];  // unit, right-handed
    Vec3d centre;
    Vec3d half;  // extents along the axes
    double volume() const { return 8 * half.x * half.y * half.z; }
    double least_width() const { return 2 * std::min(half.x, std::min(half.y, half.z)); }
};

/// Of the hull with these faces; 0 where there is none.
double hull_volume(std::span<const Vec3> points, const ExtremePoints& hull);

/// A box about all points that lies on a large face of their hull. Of the least of all boxes one side lies on a face or
/// on three edges (O'Rourke 1985). What breaks off a wall has large faces. For each of the three largest, with what is
/// within eight degrees of it, the least rectangle along an edge of the hull. Principal axes lost: those of a square
/// slab are any. Zero extents for points in a plane or on a line.
FittedBox fit_box(std::span<const Vec3> points, const ExtremePoints& hull);

}  // namespace cullet
