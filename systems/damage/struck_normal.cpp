#include "systems/damage/struck_normal.hpp"

#include <algorithm>

namespace cullet {
namespace {

/// Calls visit(vertex, square of its distance) for those that are nearer than the root of `reach`, rising; visit may
/// lower it. Nearly all are far away: blocks of a constant count vectorise.
template <class Visit>
void visit_near(const ShellView& shell, Vec3 place, const float& reach, Visit&& visit) {
    constexpr uint32_t kBlock = 32;
    const Vertices& vertices = shell.state.vertices;
    const uint32_t first = shell.vertex(0), count = shell.vertex_count();
    const float *x = vertices.rest.lane(0) + first, *y = vertices.rest.lane(1) + first,
                *z = vertices.rest.lane(2) + first;
    float square[kBlock];
    for (uint32_t block = 0; block < count; block += kBlock) {
        const uint32_t rows = std::min(kBlock, count - block);
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

}  // namespace

uint32_t nearest_vertex(ShellView shell, Vec3 place) {
    uint32_t nearest = kNone;
    float least = 1e30f;
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
