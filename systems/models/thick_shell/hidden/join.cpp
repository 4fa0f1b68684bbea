#include "systems/models/thick_shell/hidden/join.hpp"

#include <algorithm>
#include <cstring>

#include "systems/models/thick_shell/hidden/crack_rules.hpp"

namespace cullet {

uint32_t find_crack_ahead(ShellView shell, uint32_t tip, Vec3 direction, float step) {
    const Vertices& vertices = shell.state.vertices;
    const uint32_t first = shell.vertices().first, count = shell.vertex_count();
    const uint8_t* crack = vertices.crack.data() + first;
    const float l = shell.shells().mean_edge[shell.row];
    const uint32_t tip_row = shell.vertex(tip);
    const Vec3 place = vertices.rest[tip_row], inward = vertices.inward[tip_row];
    const Vec3 end = place + step * direction;
    const uint32_t root = vertices.crack_start[tip_row];
    const float root_reach = kRootReach * l;
    bool is_near_root = false;
    if (root < count) {
        const Vec3 from_root = place - vertices.rest[shell.vertex(root)];
        is_near_root = dot(from_root, from_root) <= root_reach * root_reach;
    }
    float nearest = kJoinReach * l * (kJoinReach * l);
    uint32_t found = kNone;
    for (uint32_t v = 0; v < count;) {
        // Eight flags at a time: nearly all vertices have no crack.
        uint64_t flags = 0;
        if (v % 8 == 0 && v + 8 <= count) {
            std::memcpy(&flags, crack + v, 8);
            if (flags == 0) {
                v += 8;
                continue;
            }
        }
        const uint32_t candidate = v++;
        const uint32_t row = first + candidate;
        if (crack[candidate] == static_cast<uint8_t>(CrackState::None) || candidate == tip) continue;
        if (vertices.element[row] == kNone) continue;
        if (is_near_root && vertices.crack_start[row] == root) continue;
        const Vec3 away = vertices.rest[row] - end;
        const float distance = dot(away, away);
        if (!(distance < nearest)) continue;
        const Vec3 ahead = vertices.rest[row] - place;
        if (!(dot(ahead, direction) > kJoinCosine * length(ahead))) continue;
        if (!(dot(inward, vertices.inward[row]) > kJoinCosine)) continue;
        nearest = distance;
        found = candidate;
    }
    return found;
}

void ban_starts(ShellView shell, Vec3 place) {
    Vertices& vertices = shell.state.vertices;
    const float reach = kStartSpacing * shell.shells().mean_edge[shell.row];
    const float limit = reach * reach;
    const uint32_t first = shell.vertices().first, count = shell.vertex_count();
    const float* x = vertices.rest.lane(0) + first;
    const float* y = vertices.rest.lane(1) + first;
    const float* z = vertices.rest.lane(2) + first;
    uint8_t* banned = vertices.is_start_banned.data() + first;
    for (uint32_t v = 0; v < count; ++v) {
        const float dx = x[v] - place.x, dy = y[v] - place.y, dz = z[v] - place.z;
        banned[v] = static_cast<uint8_t>(banned[v] | (dx * dx + dy * dy + dz * dz <= limit));
    }
}

void ban_starts(ShellView shell, Vec3 place, float until) {
    ban_starts(shell, place);
    Vertices& vertices = shell.state.vertices;
    const float reach = kStartSpacing * shell.shells().mean_edge[shell.row];
    for (uint32_t row = shell.vertex(0); row < shell.vertex(0) + shell.vertex_count(); ++row) {
        const Vec3 away = vertices.rest[row] - place;
        if (vertices.crack[row] != static_cast<uint8_t>(CrackState::None) || !(dot(away, away) <= reach * reach))
            continue;
        vertices.ready_time[row] = std::max(vertices.ready_time[row], until);
    }
}

}  // namespace cullet
