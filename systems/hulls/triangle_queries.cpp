#include "systems/hulls/triangle_queries.hpp"

#include <algorithm>
#include <cmath>

namespace cullet {

// The ray passes the triangle on the side that the volumes of its edges with the ray tell. An edge's volume is the same
// number, but for its sign, in both triangles that share it, so that no ray slips through between them (Woop, Benthin
// and Wald, Watertight ray/triangle intersection, 2013).
double distance_along(const Triangle3& triangle, Vec3d origin, Vec3d direction) {
    const Vec3d a = triangle.a - origin, b = triangle.b - origin, c = triangle.c - origin;
    const double u = dot(direction, cross(c, b)), v = dot(direction, cross(a, c)), w = dot(direction, cross(b, a));
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return -1;
    const double volume = u + v + w;  // minus direction times the normal
    if (volume == 0) return -1;
    return -dot(cross(triangle.b - triangle.a, triangle.c - triangle.a), a) / volume;
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
