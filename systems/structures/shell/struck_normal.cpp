#include "systems/structures/shell/struck_normal.hpp"

#include <algorithm>
#include <cmath>

#include "systems/structures/shell/vertex_sums.hpp"

namespace cullet {
namespace {

/// Calls visit(vertex, square of its distance) for those of rows [first, end) that are nearer than the root of `reach`,
/// rising; visit may lower it. Nearly all are far away: blocks of a constant count vectorise.
template <class Visit>
void visit_rows(const ShellView& shell, uint32_t begin, uint32_t end, Vec3 place, const float& reach, Visit&& visit) {
    constexpr uint32_t kBlock = 32;
    const Vertices& vertices = shell.state.vertices;
    const uint32_t first = shell.vertex(0);
    const float *x = vertices.rest.lane(0) + first, *y = vertices.rest.lane(1) + first,
                *z = vertices.rest.lane(2) + first;
    float square[kBlock];
    for (uint32_t block = begin; block < end; block += kBlock) {
        const uint32_t rows = std::min(kBlock, end - block);
        const float most = reach;
        int any = 0;
        const auto measure = [&](uint32_t i) {
            const float dx = x[block + i] - place.x, dy = y[block + i] - place.y, dz = z[block + i] - place.z;
            square[i] = dx * dx + dy * dy + dz * dz;
            any |= square[i] < most;
        };
        if (rows == kBlock)
            for (uint32_t i = 0; i < kBlock; ++i) measure(i);
        else
            for (uint32_t i = 0; i < rows; ++i) measure(i);
        if (!any) continue;
        for (uint32_t i = 0; i < rows; ++i)
            if (square[i] < reach && vertices.element[first + block + i] != kNone) visit(block + i, square[i]);
    }
}

/// Of the whole shell. Where it keeps the boxes of its blocks, those that are too far away are not looked into.
template <class Visit>
void visit_near(const ShellView& shell, Vec3 place, const float& reach, Visit&& visit) {
    const uint32_t count = shell.vertex_count();
    if (!keeps_vertex_sums(shell)) return visit_rows(shell, 0, count, place, reach, visit);
    for (uint32_t b = 0; b < block_count(shell); ++b) {
        if (!(square_to_block(shell, b, place) < reach)) continue;
        const uint32_t begin = b * kVerticesPerBlock, end = std::min(begin + kVerticesPerBlock, count);
        visit_rows(shell, begin, end, place, reach, visit);
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
    visit_rows(shell, begin, end, place, reach, [&](uint32_t, float square) { reach = square; });
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
