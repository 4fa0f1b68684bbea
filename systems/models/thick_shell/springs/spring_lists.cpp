#include "systems/models/thick_shell/springs/spring_lists.hpp"

#include <algorithm>

#include "systems/structures/shell/elements_at.hpp"

namespace cullet {
namespace {

float inverse(float rest) {
    return rest > 0 ? 1 / rest : 0;
}

template <class Rows>
SpringSlot& slot_at(const SpringsIn<Rows>& view, uint32_t place) {
    return view.state.spring_slots.slot[view.slot(place / kLanes)];
}
template <class Rows>
LayerSlot& layer_at(const SpringsIn<Rows>& view, uint32_t place) {
    return view.state.layer_slots.slot[view.layer_slot(place / kLanes)];
}

/// What stands between the layers has flowed by the mean of both.
float mean_flow(const Springs& springs, uint32_t row, const LayerSprings& layers, uint32_t layer) {
    const float outer = springs.rest_length[row] > 0 ? springs.plastic_length[row] / springs.rest_length[row] : 1;
    const float inner =
        layers.inner_length[layer] > 0 ? layers.inner_plastic[layer] / layers.inner_length[layer] : outer;
    return 0.5f * (outer + inner);
}

// `end` 0: seen from a; 1: from b, where the two diagonals of the shear pair change places.
template <class Rows>
void write_end(const SpringsIn<Rows>& view, uint32_t s, uint32_t end) {
    const Springs& springs = view.state.springs;
    const uint32_t row = view.spring(s), place = springs.place[row][end], k = place % kLanes;
    const float dt = view.own().time_step[view.row];
    SpringSlot& slot = slot_at(view, place);
    slot.neighbour[k] = end == 0 ? springs.b[row] : springs.a[row];
    slot.inverse_rest[k] = inverse(springs.plastic_length[row]);
    slot.stiffness_rest[k] = springs.stiffness[row] * springs.plastic_length[row];
    slot.damping[k] = springs.damping[row] / dt;
    if (!view.has_layers()) return;
    const LayerSprings& layers = view.state.layer_springs;
    const uint32_t layer = view.layer(s);
    const float flow = mean_flow(springs, row, layers, layer);
    const float inner = layers.inner_plastic[layer], mid = flow * layers.mid_length[layer];
    const float own_cross = flow * layers.cross_length[layer][end],
                other_cross = flow * layers.cross_length[layer][1 - end];
    LayerSlot& more = layer_at(view, place);
    more.inverse_rest[k] = inverse(inner);
    more.stiffness_rest[k] = layers.inner_stiffness[layer] * inner;
    more.damping[k] = layers.inner_damping[layer] / dt;
    const float cross = layers.cross_stiffness[layer];
    if (view.layout() == SpringLayout::Sandwich) {
        const float l = 0.5f * (own_cross + other_cross);
        more.first_inverse[k] = inverse(2 * mid);
        more.first_stiffness[k] = 0.5f * layers.mid_stiffness[layer] * mid;
        more.second_inverse[k] = l > 0 ? cross / (4 * l * l) : 0;
        more.second_stiffness[k] = other_cross * other_cross - own_cross * own_cross;
    } else {
        more.first_inverse[k] = inverse(own_cross);
        more.first_stiffness[k] = cross * own_cross;
        more.second_inverse[k] = inverse(other_cross);
        more.second_stiffness[k] = cross * other_cross;
    }
}

template <class Rows>
void write_ends(const SpringsIn<Rows>& view, uint32_t s) {
    if (view.state.springs.a[view.spring(s)] == kNone) return;
    for (const uint32_t end : {0u, 1u})
        if (view.state.springs.place[view.spring(s)][end] != kNone) write_end(view, s, end);
}

}  // namespace

bool VertexSprings::add(uint32_t s) {
    uint32_t at = count;
    while (at > 0 && spring[at - 1] > s) --at;
    if (at > 0 && spring[at - 1] == s) return true;
    if (count == std::size(spring)) return false;
    for (uint32_t i = count++; i > at; --i) spring[i] = spring[i - 1];
    spring[at] = s;
    return true;
}

void name_spring(const SpringView& view, uint32_t element, uint32_t edge, uint32_t other, uint32_t spring) {
    ShellRows& state = view.state;
    const auto& corner = state.elements.corner[view.shell.element(element)];
    const uint32_t row = view.spring(spring);
    state.springs.a[row] = corner[edge], state.springs.b[row] = corner[(edge + 1) % 3];
    state.springs.element[row] = element;
    state.springs.can_crack[row] = 1;
    state.springs.place[row] = {kNone, kNone};
    state.element_springs.spring[view.edges(element)][edge] = spring;
    if (other == kNone) return;
    for (uint32_t k = 0; k < 3; ++k)
        if (state.elements.neighbour[view.shell.element(other)][k] == element)
            state.element_springs.spring[view.edges(other)][k] = spring;
}

void collect_springs(const SpringView& view, uint32_t vertex, VertexSprings& list) {
    list.count = 0;
    if (vertex >= view.shell.vertex_count()) return;
    const Elements& elements = view.state.elements;
    for_each_element_at(view.shell, vertex, [&](uint32_t e) {
        const auto& corner = elements.corner[view.shell.element(e)];
        const uint32_t k = corner[0] == vertex ? 0 : corner[1] == vertex ? 1 : 2;
        const auto& of_element = view.state.element_springs.spring[view.edges(e)];
        for (const uint32_t s : {of_element[k], of_element[(k + 2) % 3]})
            if (s < kAsleepSpring) list.add(s);
    });
}

uint32_t slots_needed(const VertexSprings (&lists)[kLanes]) {
    uint32_t most = 0;
    for (const VertexSprings& list : lists) most = std::max(most, list.count);
    return most;
}

// What pads a list names the vertex's first neighbour again, without stiffness: its length is that of a real spring, so
// that the kernel sees lengths of 0 by their least. A vertex without springs, at the edge of a region, is given
// another's of the pack: by its own length of 0 the kernel would count the pack's lengths at each step.
void write_pack(const SpringView& view, uint32_t pack, const VertexSprings (&lists)[kLanes]) {
    ShellRows& state = view.state;
    const uint32_t row = view.pack(pack), needed = slots_needed(lists), first = state.spring_packs.first_slot[row];
    CULLET_ASSERT(needed <= state.spring_packs.slot_capacity[row], "pack %u has %u slots of room for %u", pack,
                  state.spring_packs.slot_capacity[row], needed);
    state.spring_packs.slot_count[row] = static_cast<uint16_t>(needed);
    for (uint32_t i = 0; i < needed; ++i) {
        state.spring_slots.slot[view.slot(first + i)] = {};
        if (view.has_layers()) state.layer_slots.slot[view.layer_slot(first + i)] = {};
    }
    uint32_t lone = kNone;
    for (uint32_t k = 0; k < kLanes && lone == kNone; ++k) {
        if (lists[k].count == 0) continue;
        const uint32_t s = view.spring(lists[k].spring[0]), a = state.springs.a[s];
        lone = a == pack * kLanes + k ? state.springs.b[s] : a;
    }
    for (uint32_t k = 0; k < kLanes; ++k) {
        const uint32_t v = pack * kLanes + k;
        uint32_t pad = lone == kNone ? v : lone;
        for (uint32_t i = 0; i < needed; ++i) {
            const uint32_t place = (first + i) * kLanes + k;
            if (i >= lists[k].count) {
                slot_at(view, place).neighbour[k] = pad;
                continue;
            }
            const uint32_t s = lists[k].spring[i], spring = view.spring(s);
            const uint32_t end = state.springs.a[spring] == v ? 0 : 1;
            CULLET_ASSERT(end == 0 || state.springs.b[spring] == v, "spring %u does not end at vertex %u", s, v);
            state.springs.place[spring][end] = place;
            write_end(view, s, end);
            if (i == 0) pad = slot_at(view, place).neighbour[k];
            slot_at(view, place).length[k] = state.springs.length[spring];
            if (view.has_layers()) layer_at(view, place).length[k] = state.layer_springs.length[view.layer(s)];
        }
    }
}

void write_spring(const SpringView& view, uint32_t s) {
    write_ends(view, s);
}

void write_spring(const FlowingView& view, uint32_t s) {
    write_ends(view, s);
}

void remember_length(const SpringView& view, uint32_t s) {
    Springs& springs = view.state.springs;
    const uint32_t row = view.spring(s), place = springs.place[row][0];
    const bool is_placed = place != kNone;
    springs.length[row] = is_placed ? slot_at(view, place).length[place % kLanes]
                                    : length(view.position(springs.b[row]) - view.position(springs.a[row]));
    if (!view.has_layers()) return;
    view.state.layer_springs.length[view.layer(s)] =
        is_placed ? layer_at(view, place).length[place % kLanes]
                  : length(view.twin_position(springs.b[row]) - view.twin_position(springs.a[row]));
}

void measure_lengths(const SpringView& view) {
    ShellRows& state = view.state;
    for (uint32_t p = 0; p < view.pack_count(); ++p) {
        const uint32_t row = view.pack(p), first = state.spring_packs.first_slot[row];
        for (uint32_t i = first; i < first + state.spring_packs.slot_count[row]; ++i)
            for (uint32_t k = 0; k < kLanes; ++k) {
                SpringSlot& slot = state.spring_slots.slot[view.slot(i)];
                const uint32_t v = p * kLanes + k, n = slot.neighbour[k];
                slot.length[k] = length(view.position(n) - view.position(v));
                if (view.has_layers())
                    state.layer_slots.slot[view.layer_slot(i)].length[k] =
                        length(view.twin_position(n) - view.twin_position(v));
            }
    }
    if (!view.has_layers()) return;
    for (uint32_t v = 0; v < view.shell.vertex_count(); ++v)
        state.twins.length[view.twin(v)] = length(view.twin_position(v) - view.position(v));
}

}  // namespace cullet
