// Where a ray that no mesh is likely to follow goes through triangles.
#pragma once
#include <span>

#include "engine/math.hpp"
#include "engine/ray_scene.hpp"

namespace cullet {

/// 1: the ray from p leaves what the triangle bounds, -1: it enters, 0: it passes by. In double: for decisions that may
/// go either way for a point on the surface.
inline int ray_crossing(Vec3d p, Vec3d corner_a, Vec3d corner_b, Vec3d corner_c) {
    const Vec3d ray(0.5377416, 0.6180339, 0.5733182);
    const Vec3d a = corner_a - p, b = corner_b - p, c = corner_c - p;
    const double u = dot(ray, cross(a, b)), v = dot(ray, cross(b, c)), w = dot(ray, cross(c, a));
    if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) return 0;
    const Vec3d normal = cross(b - a, c - a);
    const double along = dot(normal, ray);
    if (!(dot(normal, a) / along > 0)) return 0;
    return along > 0 ? 1 : -1;
}

/// Whether a closed mesh winds around p at all.
inline bool is_inside(Vec3d p, std::span<const Vec3d> places, std::span<const Triangle> triangles) {
    int count = 0;
    for (const Triangle& t : triangles) count += ray_crossing(p, places[t[0]], places[t[1]], places[t[2]]);
    return count > 0;
}

}  // namespace cullet
