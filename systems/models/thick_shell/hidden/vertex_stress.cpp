#include "systems/models/thick_shell/hidden/vertex_stress.hpp"

#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

/// v, perpendicular to unit n, after the least rotation that takes n to unit m.
Vec3 turned(Vec3 v, Vec3 n, Vec3 m) {
    return v - (dot(v, m) / (1 + dot(n, m))) * (n + m);
}

}  // namespace

std::array<VertexStress, 2> vertex_stress(ShellView shell, uint32_t vertex) {
    const TriangleSprings& springs = shell.state.triangle_springs;
    const Elements& elements = shell.state.elements;
    std::array<VertexStress, 2> result;
    Ring ring;
    collect_ring(shell, vertex, ring);
    Vec3 normals[kMostRing], normal, axis_x, axis_y;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const uint32_t e = shell.element(ring.element[i]);
        normals[i] = cross(springs.axis_x[e], springs.axis_y[e]);
        normal += springs.area[e] * normals[i];
    }
    normal = normalised(normal);
    float area = 0;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const uint32_t e = shell.element(ring.element[i]);
        if (!(springs.area[e] > 0) || !(dot(normals[i], normal) > 0)) continue;
        const Vec3 x = turned(springs.axis_x[e], normals[i], normal);
        if (area == 0) axis_x = normalised(x), axis_y = cross(normal, axis_x);
        // The element's axes in the vertex's: x = (c, s), y = (-s, c).
        const float c = dot(x, axis_x), s = dot(x, axis_y);
        const float a = springs.area[e];
        const auto add = [&](VertexStress& face, Vec3 t) {
            face.xx += a * (c * c * t.x + s * s * t.y - 2 * c * s * t.z);
            face.yy += a * (s * s * t.x + c * c * t.y + 2 * c * s * t.z);
            face.xy += a * (c * s * (t.x - t.y) + (c * c - s * s) * t.z);
        };
        add(result[0], elements.outer_stress[e]);
        add(result[1], elements.inner_stress[e]);
        area += a;
    }
    for (VertexStress& face : result) {
        face.axis_x = axis_x, face.axis_y = axis_y, face.normal = normal;
        if (area > 0) face.xx /= area, face.yy /= area, face.xy /= area;
    }
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
