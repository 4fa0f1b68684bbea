#include "systems/structures/shell/split_fans.hpp"

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

// The hinges of this element that name `vertex` name `copy` from now on; `others` gains their other vertices.
void rename_in_hinges(ShellView shell, uint32_t element, uint32_t vertex, uint32_t copy, VertexList& others) {
    for (const uint32_t h : shell.state.elements.hinge[shell.element(element)]) {
        if (h == kNone) continue;
        auto& named = shell.state.hinges.vertex[shell.hinge(h)];
        const auto at = std::find(named.begin(), named.end(), vertex);
        if (at != named.end()) *at = copy;
        if (at != named.end() || std::find(named.begin(), named.end(), copy) != named.end())
            for (const uint32_t v : named)
                if (v != copy && v != kNone) others.add(v);
    }
}

// Whether an element or hinge of the vertex, as it is now, holds `other` too.
bool is_row_neighbour(ShellView shell, const Ring& before, uint32_t vertex, uint32_t other) {
    const ShellRows& state = shell.state;
    for (uint32_t i = 0; i < before.count; ++i) {
        const uint32_t row = shell.element(before.element[i]);
        const auto& corner = state.elements.corner[row];
        if (corner[before.corner[i]] != vertex) continue;
        if (std::find(corner.begin(), corner.end(), other) != corner.end()) return true;
        for (const uint32_t h : state.elements.hinge[row]) {
            if (h == kNone) continue;
            const auto& named = state.hinges.vertex[shell.hinge(h)];
            if (std::find(named.begin(), named.end(), vertex) == named.end()) continue;
            if (std::find(named.begin(), named.end(), other) != named.end()) return true;
        }
    }
    return false;
}

// Rows that held the vertex, and whose element or hinge went to its copy: the stiffness is the same, so the name is
// all that changes. What holds both the vertex and its copy is built anew; so is all where pairs are stored once, for
// the vertex's lane may hold what the copy, in another pair cell, must hold with both.
void rename_in_rows(ShellView shell, const Ring& before, uint32_t vertex, uint32_t copy, const VertexList& others,
                    Touched& touched) {
    const bool once = !touched.repair.can_rename(shell.structures(), shell.structure);
    for (uint32_t i = 0; i < others.count; ++i) {
        const uint32_t other = others.vertex[i];
        if (once || is_row_neighbour(shell, before, vertex, other))
            touched.rows.add(other);
        else
            touched.repair.rename(shell, other, vertex, copy);
    }
    if (others.has_overflowed) touched.rows.has_overflowed = true;
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

uint32_t split_fans(ShellView shell, uint32_t vertex, const Ring& before, Touched& touched) {
    ShellRows& state = shell.state;
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
        VertexList others;
        for (uint32_t i = begin; i < end; ++i) {
            auto& corner = state.elements.corner[shell.element(before.element[at(i)])];
            corner[before.corner[at(i)]] = owner;
            for (const uint32_t v : corner)
                if (v != owner) others.add(v);
            rename_in_hinges(shell, before.element[at(i)], vertex, owner, others);
        }
        rename_in_rows(shell, before, vertex, owner, others, touched);
    }
    weigh_vertex(shell, vertex);
    for (uint32_t c = shell.vertex_count() - copies; c < shell.vertex_count(); ++c) weigh_vertex(shell, c);
    return copies;
}

}  // namespace cullet
