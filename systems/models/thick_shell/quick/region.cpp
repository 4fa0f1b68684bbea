#include "systems/models/thick_shell/quick/region.hpp"

#include "systems/structures/shell/elements_at.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

constexpr uint32_t kUnseen = kNone - 3;  // of Vertices.copy: else the next vertex of the queue, kNone at its end

/// Vertices in the order in which the flood found them, chained through Vertices.copy: no list of unknown length.
struct Queue {
    const ShellView& shell;
    uint32_t first = kNone, last = kNone, count = 0;

    uint32_t& next(uint32_t v) const { return shell.state.vertices.copy[shell.vertex(v)]; }
    void add(uint32_t v) {
        if (next(v) != kUnseen) return;
        next(v) = kNone;
        if (last != kNone) next(last) = v;
        if (first == kNone) first = v;
        last = v;
        ++count;
    }
};

void add_seeds(RunRows& state, Row<Tasks> task, Queue& queue) {
    const TaskContacts& contacts = state.task_contacts;
    const uint32_t first = state.tasks.first_contact[task], count = state.tasks.contact_count[task];
    for (uint32_t c = first; c < first + count; ++c) {
        queue.add(contacts.vertex[c]);
        for (uint32_t p = contacts.first_patch[c]; p < contacts.first_patch[c] + contacts.patch_count[c]; ++p)
            queue.add(state.patch_vertices.vertex[p]);
    }
    if (count > 0) return;
    for (uint32_t v = 0; v < queue.shell.vertex_count(); ++v)
        if (state.vertices.element[queue.shell.vertex(v)] != kNone) queue.add(v);
}

/// Marks the region; returns how many vertices are awake.
uint32_t mark(RunRows& state, Row<Tasks> task, uint32_t rings) {
    const ShellView shell(state, state.tasks.working[task]);
    Queue queue{shell};
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) queue.next(v) = kUnseen;
    uint32_t* const is_seen = state.elements.next.data() + shell.elements().first;
    std::fill_n(is_seen, shell.element_count(), 0u);
    add_seeds(state, task, queue);
    uint32_t at = queue.first, awake = 0, seen = 0, ring = 0, end_of_ring = queue.count;
    while (at != kNone) {
        if (seen == end_of_ring) {
            if (ring == rings) break;  // what is queued behind it is held
            ++ring;
            end_of_ring = queue.count;
        }
        for_each_element_at(shell, at, [&](uint32_t e) {
            if (is_seen[e]) return;
            is_seen[e] = 1;
            for (const uint32_t v : state.elements.corner[shell.element(e)]) queue.add(v);
        });
        ++seen, ++awake;
        at = queue.next(at);
    }
    uint32_t v = queue.first;
    for (uint32_t i = 0; v != kNone; ++i) {
        const uint32_t next = queue.next(v);
        queue.next(v) = i < awake ? kAwakeMark : kHeldMark;
        v = next;
    }
    for (uint32_t u = 0; u < shell.vertex_count(); ++u)
        if (queue.next(u) == kUnseen) queue.next(u) = kAsleepMark;
    return awake;
}

/// False: there are too many.
bool list_packs(RunRows& state, Row<Tasks> task) {
    const ShellView shell(state, state.tasks.working[task]);
    MarkedPacks& packs = state.marked_packs;
    const uint32_t first = task * kMostMarkedPacks;
    uint32_t count = 0;
    for (uint32_t v = 0; v < shell.vertex_count(); v += kLanes) {
        uint32_t awake = 0, held = 0;
        for (uint32_t k = 0; k < std::min(kLanes, shell.vertex_count() - v); ++k) {
            const uint32_t mark = state.vertices.copy[shell.vertex(v + k)];
            awake |= uint32_t{mark == kAwakeMark} << k;
            held |= uint32_t{mark == kHeldMark} << k;
        }
        if (!(awake | held)) continue;
        if (count == kMostMarkedPacks) return false;
        packs.pack[first + count] = v / kLanes;
        packs.awake[first + count] = static_cast<uint8_t>(awake);
        packs.held[first + count] = static_cast<uint8_t>(held);
        ++count;
    }
    state.hidden_runs.pack_count[task] = count;
    return true;
}

/// Puts what lies behind the listed packs to sleep, and holds what is next to it; returns how many are awake.
uint32_t leave_out_the_rest(RunRows& state, Row<Tasks> task) {
    const ShellView shell(state, state.tasks.working[task]);
    const auto mark_of = [&](uint32_t v) -> uint32_t& { return state.vertices.copy[shell.vertex(v)]; };
    const uint32_t end = (state.marked_packs.pack[(task + 1) * kMostMarkedPacks - 1] + 1) * kLanes;
    for (uint32_t v = end; v < shell.vertex_count(); ++v) mark_of(v) = kAsleepMark;
    uint32_t awake = 0;
    Ring ring;
    for (uint32_t v = 0; v < std::min(end, shell.vertex_count()); ++v) {
        if (mark_of(v) != kAwakeMark) continue;
        walk_ring(shell, v, ring);
        for (uint32_t i = 0; i < ring.count; ++i)
            for (const uint32_t u : state.elements.corner[shell.element(ring.element[i])])
                if (mark_of(u) == kAsleepMark) mark_of(v) = kHeldMark;
        awake += mark_of(v) == kAwakeMark;
    }
    return awake;
}

}  // namespace

void choose_region(RunRows& state, Row<Tasks> task, uint32_t rings) {
    MarkedPacks& packs = state.marked_packs;
    const uint32_t end = (task + 1) * kMostMarkedPacks;
    if (end > packs.size()) packs.append(end - packs.size());
    packs.clear_rows(task * kMostMarkedPacks, kMostMarkedPacks);
    for (;;) {
        state.quick_runs.awake_count[task] = mark(state, task, rings);
        if (list_packs(state, task)) return;
        if (rings == 0) break;
        rings = rings * 3 / 4;
    }
    // An explosion on a body of more packs, or seeds of as many: the last ones sleep.
    state.quick_runs.awake_count[task] = leave_out_the_rest(state, task);
    list_packs(state, task);
}

void RegionView::add(uint32_t v, bool is_held) const {
    MarkedPacks& packs = state.marked_packs;
    uint32_t row = find(v / kLanes);
    if (row == kNone) {
        uint32_t& count = state.hidden_runs.pack_count[task];
        const bool is_behind = count == 0 || packs.pack[first_row() + count - 1] < v / kLanes;
        if (!is_behind || count == kMostMarkedPacks) return;
        row = first_row() + count++;
        packs.pack[row] = v / kLanes;
        packs.awake[row] = packs.held[row] = 0;
    }
    auto& column = is_held ? packs.held : packs.awake;
    column[row] = static_cast<uint8_t>(column[row] | 1u << (v % kLanes));
}

}  // namespace cullet
