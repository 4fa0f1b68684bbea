#include "systems/structures/shell/struck_normal.hpp"

#include <algorithm>
#include <cmath>

#include "systems/structures/shell/near_vertices.hpp"
#include "systems/structures/shell/vertex_sums.hpp"

namespace cullet {
namespace {

/// Of the whole shell. Where it keeps the boxes of its blocks, those that are too far away are not looked into.
template <class Visit>
void visit_near(const ShellView& shell, Vec3 place, const float& reach, Visit&& visit) {
    const uint32_t count = shell.vertex_count();
    if (!keeps_vertex_sums(shell)) return visit_rows_near(shell, 0, count, place, reach, visit);
    for (uint32_t b = 0; b < block_count(shell); ++b) {
        if (!(square_to_block(shell, b, place) < reach)) continue;
        const uint32_t begin = b * kVerticesPerBlock, end = std::min(begin + kVerticesPerBlock, count);
        visit_rows_near(shell, begin, end, place, reach, visit);
    }
}

/// No less than the square of the way to the nearest vertex, and above it: from the block whose box is nearest.
float reach_of_nearest(const ShellView& shell, Vec3 place) {
    float reach = 1e30f;
    if (!keeps_vertex_sums(shell)) return reach;
    uint32_t best = 0;
    float least = reach;
    for (uint32_t b = 0; b < block_count(shell); ++b)
        if (const float square = square_to_block(shell, b, place); square < least) least = square, best = b;
    const uint32_t begin = best * kVerticesPerBlock, end = std::min(begin + kVerticesPerBlock, shell.vertex_count());
    visit_rows_near(shell, begin, end, place, reach, [&](uint32_t, float square) { reach = square; });
    return std::nextafter(reach, 2e30f);
}

}  // namespace

uint32_t nearest_vertex(ShellView shell, Vec3 place) {
    uint32_t nearest = kNone;
    float least = reach_of_nearest(shell, place);
    visit_near(shell, place, least, [&](uint32_t v, float square) {
        least = square;
        nearest = v;
    });
    return nearest;
}

Vec3 struck_normal(ShellView shell, Vec3 place, Vec3 normal, float radius) {
    constexpr float kLeastCosine = 0.7f;
    const Vertices& vertices = shell.state.vertices;
    const uint32_t nearest = nearest_vertex(shell, place);
    if (nearest == kNone) return normal;
    const Vec3 centre = vertices.rest[shell.vertex(nearest)];
    Vec3d inward;
    const float most = radius * radius, reach = 1.001f * most;
    visit_near(shell, centre, reach, [&](uint32_t v, float square) {
        if (square > most) return;
        inward += vertices.mass[shell.vertex(v)] * Vec3d(vertices.inward[shell.vertex(v)]);
    });
    const Vec3 average = normalised(inward).to_float();
    const float along = dot(average, normal);
    if (along > kLeastCosine) return average;
    return along < -kLeastCosine ? -average : normal;  // the second: struck from the inside
}

}  // namespace cullet
