#include "systems/structures/shell/cut_ends.hpp"

#include "systems/structures/shell/cut_edge.hpp"
#include "systems/structures/shell/split_fans.hpp"

namespace cullet {
namespace {

// Index in the ring of the element whose first edge runs from the vertex to `end` and has a neighbour across, or kNone.
uint32_t element_before(ShellView shell, const Ring& ring, uint32_t end) {
    for (uint32_t i = 0; i < ring.count; ++i) {
        const uint32_t row = shell.element(ring.element[i]);
        const uint32_t k = ring.corner[i];
        if (shell.state.elements.corner[row][(k + 1) % 3] != end) continue;
        return shell.state.elements.neighbour[row][k] == kNone ? kNone : i;
    }
    return kNone;
}

void split_and_mark(ShellView shell, uint32_t vertex, const Ring& before, Touched& touched) {
    shell.state.vertices.crack[shell.vertex(vertex)] = static_cast<uint8_t>(CrackState::Cracked);
    touched.add(vertex);
    const uint32_t copies = split_fans(shell, vertex, before, touched);
    for (uint32_t c = shell.vertex_count() - copies; c < shell.vertex_count(); ++c) touched.add(c);
}

}  // namespace

CutOutcome cut_ends(ShellView shell, uint32_t vertex, Ends& ends, Touched& touched) {
    Ring ring, end_ring[kMostArms];
    uint32_t first[kMostArms];
    walk_ring(shell, vertex, ring);
    if (ring.count == 0 || ends.count < (ring.is_closed ? 2u : 1u)) return CutOutcome::Impossible;
    uint32_t copies = ring.is_closed ? ends.count - 1 : ends.count;
    for (uint32_t i = 0; i < ends.count; ++i) {
        first[i] = element_before(shell, ring, ends.end[i]);
        walk_ring(shell, ends.end[i], end_ring[i]);
        if (first[i] == kNone || end_ring[i].count == 0) return CutOutcome::Impossible;
        ends.is_interior[i] = end_ring[i].is_closed;
        copies += !end_ring[i].is_closed;
    }
    if (shell.vertex_count() + copies > shell.vertices().capacity) return CutOutcome::Full;

    for (uint32_t i = 0; i < ends.count; ++i) {
        const uint32_t hinge = shell.state.elements.hinge[shell.element(ring.element[first[i]])][ring.corner[first[i]]];
        if (hinge != kNone) touched.add_hinge(shell, hinge);
        touched.add(ends.end[i]);
        cut_edge(shell, ring.element[first[i]], ring.corner[first[i]]);
    }
    split_and_mark(shell, vertex, ring, touched);
    for (uint32_t i = 0; i < ends.count; ++i) {
        if (!ends.is_interior[i]) split_and_mark(shell, ends.end[i], end_ring[i], touched);
    }
    shell.structures().has_cracks[shell.structure] = 1;
    return CutOutcome::Cut;
}

}  // namespace cullet
