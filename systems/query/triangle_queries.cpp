#include "systems/query/triangle_queries.hpp"

#include <algorithm>
#include <cmath>

namespace cullet {

// Moeller and Trumbore: origin + t direction = (1 - u - v) a + u b + v c, by Cramer's rule.
double distance_along(const Triangle3& triangle, Vec3d origin, Vec3d direction) {
    const Vec3d ab = triangle.b - triangle.a, ac = triangle.c - triangle.a, p = cross(direction, ac);
    const double volume = dot(ab, p);
    if (volume == 0) return -1;
    const Vec3d from = origin - triangle.a;
    const double u = dot(from, p) / volume;
    if (!(u >= 0 && u <= 1)) return -1;
    const Vec3d q = cross(from, ab);
    const double v = dot(direction, q) / volume;
    if (!(v >= 0 && u + v <= 1)) return -1;
    return dot(ac, q) / volume;
}

// By the regions of its corners, edges and face (Ericson, Real-Time Collision Detection, 5.1.5).
Vec3d nearest_point(const Triangle3& triangle, Vec3d p) {
    const auto [a, b, c] = triangle;
    const Vec3d ab = b - a, ac = c - a;
    const double d1 = dot(ab, p - a), d2 = dot(ac, p - a);
    if (d1 <= 0 && d2 <= 0) return a;
    const double d3 = dot(ab, p - b), d4 = dot(ac, p - b);
    if (d3 >= 0 && d4 <= d3) return b;
    const double beside_ab = d1 * d4 - d3 * d2;
    if (beside_ab <= 0 && d1 >= 0 && d3 <= 0) return a + (d1 / (d1 - d3)) * ab;
    const double d5 = dot(ab, p - c), d6 = dot(ac, p - c);
    if (d6 >= 0 && d5 <= d6) return c;
    const double beside_ac = d5 * d2 - d1 * d6;
    if (beside_ac <= 0 && d2 >= 0 && d6 <= 0) return a + (d2 / (d2 - d6)) * ac;
    const double beside_bc = d3 * d6 - d5 * d4;
    if (beside_bc <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
    const double sum = beside_ab + beside_ac + beside_bc;
    return a + (beside_ac / sum) * ab + (beside_ab / sum) * ac;
}

// Separating axes: the box's three, the triangle's normal, nine products of edges and axes.
bool meets_box(const Triangle3& triangle, Vec3d centre, Vec3d half) {
    const Vec3d corner[3] = {triangle.a - centre, triangle.b - centre, triangle.c - centre};
    const Vec3d edge[3] = {corner[1] - corner[0], corner[2] - corner[1], corner[0] - corner[2]};
    const Vec3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto separates = [&](Vec3d axis) {
        const double p[3] = {dot(axis, corner[0]), dot(axis, corner[1]), dot(axis, corner[2])};
        const double reach = half.x * std::fabs(axis.x) + half.y * std::fabs(axis.y) + half.z * std::fabs(axis.z);
        return std::min({p[0], p[1], p[2]}) > reach || std::max({p[0], p[1], p[2]}) < -reach;
    };
    for (const Vec3d axis : axes)
        if (separates(axis)) return false;
    if (separates(cross(edge[0], edge[1]))) return false;
    for (const Vec3d e : edge)
        for (const Vec3d axis : axes)
            if (separates(cross(e, axis))) return false;
    return true;
}

}  // namespace cullet
