#include "systems/damage/split_fans.hpp"

#include <algorithm>

namespace cullet {
namespace {

bool is_linked(ShellView shell, const Ring& ring, uint32_t i, uint32_t next) {
    const uint32_t row = shell.element(ring.element[i]);
    return shell.state.elements.neighbour[row][(ring.corner[i] + 2) % 3] == ring.element[next];
}

// Index in the ring where some fan begins; kNone when a closed ring has no cut or only one. (One cut opens a cycle to a
// chain of one fan.)
uint32_t first_fan(ShellView shell, const Ring& ring) {
    if (!ring.is_closed) return 0;
    uint32_t breaks = 0, found = kNone;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const uint32_t next = (i + 1) % ring.count;
        if (is_linked(shell, ring, i, next)) continue;
        ++breaks;
        if (found == kNone) found = next;
    }
    return breaks > 1 ? found : kNone;
}

// The hinges of this element that name `vertex` name `copy` from now on.
void rename_in_hinges(ShellView shell, uint32_t element, uint32_t vertex, uint32_t copy) {
    for (const uint32_t h : shell.state.elements.hinge[shell.element(element)]) {
        if (h == kNone) continue;
        auto& named = shell.state.hinges.vertex[shell.hinge(h)];
        const auto at = std::find(named.begin(), named.end(), vertex);
        if (at != named.end()) *at = copy;
    }
}

}  // namespace

uint32_t count_fans(ShellView shell, const Ring& before) {
    if (before.count == 0) return 0;
    uint32_t breaks = 0;
    for (uint32_t i = 0; i + 1 < before.count; ++i) breaks += !is_linked(shell, before, i, i + 1);
    if (!before.is_closed) return breaks + 1;
    breaks += !is_linked(shell, before, before.count - 1, 0);
    return breaks > 1 ? breaks : 1;
}

uint32_t split_fans(ShellView shell, uint32_t vertex, const Ring& before) {
    State& state = shell.state;
    const uint32_t start = first_fan(shell, before);
    if (before.count == 0) return 0;
    if (start == kNone) {
        weigh_vertex(shell, vertex);
        return 0;
    }
    const auto at = [&](uint32_t i) { return (start + i) % before.count; };
    const uint32_t smallest =
        static_cast<uint32_t>(std::min_element(before.element, before.element + before.count) - before.element);
    uint32_t copies = 0;
    for (uint32_t begin = 0, end = 0; begin < before.count; begin = end) {
        for (end = begin + 1; end < before.count && is_linked(shell, before, at(end - 1), at(end));) ++end;
        bool is_keeper = false;
        for (uint32_t i = begin; i < end; ++i) is_keeper |= at(i) == smallest;
        uint32_t owner = vertex;
        if (!is_keeper) {
            Range& range = shell.vertices();
            CULLET_ASSERT(range.count < range.capacity, "no room for a copy of vertex %u", vertex);
            owner = range.count++;
            state.vertices.copy_rows(state.vertices, shell.vertex(vertex), shell.vertex(owner), 1);
            ++copies;
        }
        state.vertices.element[shell.vertex(owner)] = before.element[at(begin)];
        if (is_keeper) continue;
        for (uint32_t i = begin; i < end; ++i) {
            state.elements.corner[shell.element(before.element[at(i)])][before.corner[at(i)]] = owner;
            rename_in_hinges(shell, before.element[at(i)], vertex, owner);
        }
    }
    weigh_vertex(shell, vertex);
    for (uint32_t c = shell.vertex_count() - copies; c < shell.vertex_count(); ++c) weigh_vertex(shell, c);
    return copies;
}

}  // namespace cullet
