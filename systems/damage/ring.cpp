#include "systems/damage/ring.hpp"

namespace cullet {

uint8_t corner_of(ShellView shell, uint32_t element, uint32_t vertex) {
    const auto& corner = shell.state.elements.corner[shell.element(element)];
    for (uint8_t k = 0; k < 3; ++k)
        if (corner[k] == vertex) return k;
    return 3;
}

void walk_ring(ShellView shell, uint32_t vertex, Ring& ring) {
    ring.count = 0;
    ring.is_closed = ring.is_cut_short = false;
    const Elements& elements = shell.state.elements;
    const uint32_t begin = shell.state.vertices.element[shell.vertex(vertex)];
    if (begin == kNone) return;

    // Backwards to the first element of the chain, or round the cycle to its smallest.
    uint32_t first = begin;
    uint32_t at = begin;
    for (uint32_t steps = 0;; ++steps) {
        const uint8_t k = corner_of(shell, at, vertex);
        CULLET_ASSERT(k < 3, "element %u is no neighbour of vertex %u", at, vertex);
        const uint32_t before = elements.neighbour[shell.element(at)][k];
        if (before == kNone) {
            first = at;
            break;
        }
        if (before == begin) {
            ring.is_closed = true;
            break;
        }
        if (steps > kMostRing) break;  // the walk below finds the same
        at = before;
        first = at < first ? at : first;
    }
    at = first;
    do {
        if (ring.count == kMostRing) {
            ring.count = 0;
            ring.is_closed = false;
            ring.is_cut_short = true;
            return;
        }
        const uint8_t k = corner_of(shell, at, vertex);
        ring.element[ring.count] = at;
        ring.corner[ring.count] = k;
        ++ring.count;
        at = elements.neighbour[shell.element(at)][(k + 2) % 3];
    } while (at != kNone && at != first);
}

Vec3 ring_normal(ShellView shell, const Ring& ring) {
    Vec3 sum;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const auto& corner = shell.state.elements.corner[shell.element(ring.element[i])];
        const auto rest = [&](int k) { return shell.state.vertices.rest[shell.vertex(corner[k])]; };
        sum += cross(rest(1) - rest(0), rest(2) - rest(0));
    }
    return normalised(sum);
}

void weigh_vertex(ShellView shell, uint32_t vertex) {
    Ring ring;
    walk_ring(shell, vertex, ring);
    if (ring.is_cut_short) return;  // such a vertex is never split, and no element at it is
    double sum = 0;
    for (uint32_t i = 0; i < ring.count; ++i) sum += shell.state.elements.mass[shell.element(ring.element[i])];
    Vertices& vertices = shell.state.vertices;
    const uint32_t row = shell.vertex(vertex);
    const double mass = sum / 3;
    vertices.mass[row] = mass;
    const bool is_free = mass > 0 && !vertices.is_pinned[row];
    vertices.inverse_mass[row] = is_free ? static_cast<float>(1 / mass) : 0.0f;
}

}  // namespace cullet
