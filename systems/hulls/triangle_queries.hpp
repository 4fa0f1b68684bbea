// One triangle against a ray, a point, a box; all in double.
#pragma once
#include "engine/math.hpp"

namespace cullet {

struct Triangle3 {
    Vec3d a, b, c;
};

/// How far along the unit direction the ray meets the triangle, from either side, edges and corners included; negative
/// when it does not, or runs along its plane.
double distance_along(const Triangle3& triangle, Vec3d origin, Vec3d direction);
/// The point of the triangle nearest to p.
Vec3d nearest_point(const Triangle3& triangle, Vec3d p);
/// Whether it shares a point with the box of this centre and half extents, along the axes.
bool meets_box(const Triangle3& triangle, Vec3d centre, Vec3d half);

}  // namespace cullet
