#include "systems/damage/vertex_stress.hpp"

#include "systems/damage/ring.hpp"

namespace cullet {
namespace {

/// v, perpendicular to unit n, after the least rotation that takes n to unit m.
Vec3 turned(Vec3 v, Vec3 n, Vec3 m) {
    return v - (dot(v, m) / (1 + dot(n, m))) * (n + m);
}

}  // namespace

VertexStress vertex_stress(ShellView shell, uint32_t vertex, int face) {
    const TriangleSprings& springs = shell.state.triangle_springs;
    const Elements& elements = shell.state.elements;
    const Column<Vec3>& stress = face == 0 ? elements.outer_stress : elements.inner_stress;
    VertexStress result;
    Ring ring;
    collect_ring(shell, vertex, ring);
    Vec3 normals[kMostRing];
    for (uint32_t i = 0; i < ring.count; ++i) {
        const uint32_t e = shell.element(ring.element[i]);
        normals[i] = cross(springs.axis_x[e], springs.axis_y[e]);
        result.normal += springs.area[e] * normals[i];
    }
    result.normal = normalised(result.normal);
    float area = 0;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const uint32_t e = shell.element(ring.element[i]);
        if (!(springs.area[e] > 0) || !(dot(normals[i], result.normal) > 0)) continue;
        const Vec3 x = turned(springs.axis_x[e], normals[i], result.normal);
        if (area == 0) result.axis_x = normalised(x), result.axis_y = cross(result.normal, result.axis_x);
        // The element's axes in the vertex's: x = (c, s), y = (-s, c).
        const float c = dot(x, result.axis_x), s = dot(x, result.axis_y);
        const Vec3 t = stress[e];
        const float a = springs.area[e];
        result.xx += a * (c * c * t.x + s * s * t.y - 2 * c * s * t.z);
        result.yy += a * (s * s * t.x + c * c * t.y + 2 * c * s * t.z);
        result.xy += a * (c * s * (t.x - t.y) + (c * c - s * s) * t.z);
        area += a;
    }
    if (area > 0) result.xx /= area, result.yy /= area, result.xy /= area;
    return result;
}

void principal(const VertexStress& stress, float& s1, float& s2, Vec3& direction1) {
    const float mean = 0.5f * (stress.xx + stress.yy), d = 0.5f * (stress.xx - stress.yy);
    const float radius = std::sqrt(d * d + stress.xy * stress.xy);
    s1 = mean + radius, s2 = mean - radius;
    // Half-angle of (d, xy): (radius + d, xy), or (xy, radius - d) where that is the longer of the two.
    const float x = d >= 0 ? radius + d : stress.xy, y = d >= 0 ? stress.xy : radius - d;
    direction1 = radius > 0 ? normalised(x * stress.axis_x + y * stress.axis_y) : stress.axis_x;
}

}  // namespace cullet
