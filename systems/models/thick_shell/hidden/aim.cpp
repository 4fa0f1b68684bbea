#include "systems/models/thick_shell/hidden/aim.hpp"

#include "systems/models/thick_shell/hidden/crack_rules.hpp"

namespace cullet {
namespace {

// Where a direction leaves the ring.
struct Crossing {
    uint32_t index = kNone;  // in the ring
    float tau = 0;           // from the corner after the vertex to the one before it
};

Crossing find_crossing(ShellView shell, Vec3 place, const Ring& ring, Vec3 x, Vec3 y) {
    Crossing found;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const auto& corner = shell.state.elements.corner[shell.element(ring.element[i])];
        const auto seen = [&](uint32_t k) {
            return shell.state.vertices.rest[shell.vertex(corner[(ring.corner[i] + k) % 3])] - place;
        };
        const Vec3 p = seen(1), q = seen(2);
        const float py = dot(p, y), qy = dot(q, y);
        // Half open, so that of two triangles at an edge along the direction exactly one is entered. A chain's last
        // edge belongs to its last triangle, at tau = 1.
        const bool is_last_edge = !ring.is_closed && i + 1 == ring.count && qy == 0;
        if (!(py <= 0 && (qy > 0 || is_last_edge)) || py == qy) continue;
        const float tau = py / (py - qy);
        const float ahead = dot(p, x) + tau * (dot(q, x) - dot(p, x));
        if (!(ahead > 0)) continue;
        return {i, tau};
    }
    return found;
}

bool is_cuttable(ShellView shell, const Ring& ring, uint32_t index, bool is_first_edge, Vec3 place, Vec3 direction) {
    const Elements& elements = shell.state.elements;
    const uint32_t row = shell.element(ring.element[index]);
    const uint32_t k = ring.corner[index];
    if (elements.neighbour[row][is_first_edge ? k : (k + 2) % 3] == kNone) return false;
    const uint32_t end = elements.corner[row][(k + (is_first_edge ? 1 : 2)) % 3];
    const Vec3 along = shell.state.vertices.rest[shell.vertex(end)] - place;
    return dot(along, direction) >= kTurnCosine * length(along);
}

}  // namespace

Aim aim(ShellView shell, uint32_t vertex, Vec3 normal, Vec3 direction, Touched& touched) {
    Aim result;
    Ring ring;
    walk_ring(shell, vertex, ring);
    const Vec3 place = shell.state.vertices.rest[shell.vertex(vertex)];
    const Crossing crossing = find_crossing(shell, place, ring, direction, cross(normal, direction));
    if (crossing.index == kNone) return result;
    const uint32_t element = ring.element[crossing.index];
    const uint32_t k = ring.corner[crossing.index];
    const float tau = crossing.tau;
    if (tau >= kSnap && tau <= 1 - kSnap) {
        if (can_insert(shell, element, (k + 1) % 3, tau, result.was_full)) {
            result.end = insert_vertex(shell, element, (k + 1) % 3, tau, touched);
            result.was_inserted = true;
            return result;
        }
    }
    const auto& corner = shell.state.elements.corner[shell.element(element)];
    const bool first_is_nearer = tau <= 0.5f;
    for (const bool is_first : {first_is_nearer, !first_is_nearer}) {
        if (!is_cuttable(shell, ring, crossing.index, is_first, place, direction)) continue;
        result.end = corner[(k + (is_first ? 1 : 2)) % 3];
        return result;
    }
    return result;
}

}  // namespace cullet
