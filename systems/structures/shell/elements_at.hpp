// The elements at a vertex, in no order that tells anything: for floods.
#pragma once
#include "systems/structures/shell/ring.hpp"

namespace cullet {

/// Calls f(element) for each element of the vertex's fan, once; a quarter of what walk_ring takes, which orders them
/// and remembers them. A dead vertex has none. True: the fan is closed.
template <class F>
bool for_each_element_at(const ShellView& shell, uint32_t vertex, F&& f) {
    const Elements& elements = shell.state.elements;
    const uint32_t begin = shell.state.vertices.element[shell.vertex(vertex)];
    // Across the edge that ends at the vertex until a border or the begin, then the other way round.
    for (const uint32_t turn : {2u, 0u}) {
        uint32_t at = begin, steps = 0;
        while (at != kNone && steps++ < kMostRing) {
            if (turn == 2 || at != begin) f(at);
            const auto& corner = elements.corner[shell.element(at)];
            const uint32_t k = corner[0] == vertex ? 0 : corner[1] == vertex ? 1 : 2;
            if (corner[k] != vertex) return false;
            at = elements.neighbour[shell.element(at)][(k + turn) % 3];
            if (at == begin) return true;
        }
    }
    return false;
}

}  // namespace cullet
