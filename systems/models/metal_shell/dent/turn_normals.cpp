#include "systems/models/metal_shell/dent/turn_normals.hpp"

#include <algorithm>

#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

constexpr float kOneNormal = 0.9986f;  // cosine of 3 degrees: corners that were drawn as one surface
constexpr float kSharp = 0.64f;        // of 50: from there on a fold is drawn as an edge

/// Twice the area, along the normal.
Vec3 across(const MetalView& metal, const Column<Vec3>& places, uint32_t element) {
    const auto& c = metal.corners(element);
    const Vec3 p = places[metal.vertex(c[0])];
    return cross(places[metal.vertex(c[1])] - p, places[metal.vertex(c[2])] - p);
}

// By the rotation that takes one unit vector to another.
Vec3 turned_along(Vec3 from, Vec3 to, Vec3 vector) {
    const Vec3 axis = cross(from, to);
    const float cosine = dot(from, to);
    if (cosine < -0.999f) return vector - 2 * dot(vector, from) * from;
    return vector + cross(axis, vector) + (1 / (1 + cosine)) * cross(axis, cross(axis, vector));
}

/// An element of a ring: its normal at the vertex before, and as it turned.
struct Turned {
    Vec3 before, after;
    float area;
};
Turned turned_corner(const MetalView& metal, uint32_t element, uint32_t corner) {
    const auto& all = metal.shell.state.elements.normal[metal.shell.element(element)];
    const Vec3 normal{all[3 * corner], all[3 * corner + 1], all[3 * corner + 2]};
    const Vec3 then = across(metal, metal.vertices().start, element),
               now = across(metal, metal.vertices().place, element);
    const float was = length(then), is = length(now);
    if (!(was > 0) || !(is > 0)) return {normal, normal, is};
    return {normal, turned_along((1 / was) * then, (1 / is) * now, normal), is};
}

void turn_corners(const MetalView& metal, const Ring& ring) {
    Turned turned[kMostRing];
    for (uint32_t i = 0; i < ring.count; ++i) turned[i] = turned_corner(metal, ring.element[i], ring.corner[i]);
    for (uint32_t i = 0; i < ring.count; ++i) {
        if (!has_moved(metal, ring.element[i])) continue;
        Vec3 sum;
        for (uint32_t j = 0; j < ring.count; ++j)
            if (dot(turned[i].before, turned[j].before) > kOneNormal && dot(turned[i].after, turned[j].after) > kSharp)
                sum += turned[j].area * turned[j].after;
        const Vec3 n = dot(sum, sum) > 0 ? normalised(sum) : turned[i].after;
        auto& all = metal.shell.state.elements.normal[metal.shell.element(ring.element[i])];
        const size_t k = 3 * size_t{ring.corner[i]};
        all[k] = n.x, all[k + 1] = n.y, all[k + 2] = n.z;
    }
}

}  // namespace

bool has_moved(const MetalView& metal, uint32_t element) {
    const MetalVertices& own = metal.vertices();
    const auto& c = metal.corners(element);
    return std::any_of(c.begin(), c.end(),
                       [&](uint32_t v) { return !(own.place[metal.vertex(v)] == own.start[metal.vertex(v)]); });
}

// Corners at one vertex hang on each other, and on no others.
void turn_normals(const MetalView& metal) {
    MetalVertices& own = metal.vertices();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) own.is_queued[metal.vertex(v)] = 0;
    for (uint32_t e = 0; e < metal.element_count(); ++e)
        if (!metal.is_dead(e) && has_moved(metal, e))
            for (const uint32_t v : metal.corners(e)) own.is_queued[metal.vertex(v)] = 1;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v);
        if (!own.is_queued[row]) continue;
        Ring ring;
        collect_ring(metal.shell, v, ring);
        turn_corners(metal, ring);
        if (own.place[row] == own.start[row]) continue;
        const Vec3 normal = ring_normal(metal.shell, ring);
        if (dot(normal, normal) > 0.5f) metal.shell.state.vertices.inward.set(metal.shell.vertex(v), -normal);
    }
}

}  // namespace cullet
