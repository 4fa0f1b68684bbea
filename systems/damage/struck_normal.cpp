#include "systems/damage/struck_normal.hpp"

namespace cullet {

uint32_t nearest_vertex(ShellView shell, Vec3 place) {
    const Vertices& vertices = shell.state.vertices;
    uint32_t nearest = kNone;
    float least = 1e30f;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        if (vertices.element[row] == kNone) continue;
        const Vec3 away = vertices.rest[row] - place;
        if (dot(away, away) >= least) continue;
        least = dot(away, away);
        nearest = v;
    }
    return nearest;
}

Vec3 struck_normal(ShellView shell, Vec3 place, Vec3 normal, float radius) {
    constexpr float kLeastCosine = 0.7f;
    const Vertices& vertices = shell.state.vertices;
    const uint32_t nearest = nearest_vertex(shell, place);
    if (nearest == kNone) return normal;
    const Vec3 centre = vertices.rest[shell.vertex(nearest)];
    Vec3d inward;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        const Vec3 away = vertices.rest[row] - centre;
        if (vertices.element[row] == kNone || dot(away, away) > radius * radius) continue;
        inward += vertices.mass[row] * Vec3d(vertices.inward[row]);
    }
    const Vec3 average = normalised(inward).to_float();
    const float along = dot(average, normal);
    if (along > kLeastCosine) return average;
    return along < -kLeastCosine ? -average : normal;  // the second: struck from the inside
}

}  // namespace cullet
