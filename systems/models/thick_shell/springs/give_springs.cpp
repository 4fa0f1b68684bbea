#include "systems/models/thick_shell/springs/give_springs.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "systems/models/thick_shell/springs/edge_stiffness.hpp"
#include "systems/models/thick_shell/springs/spring_lists.hpp"

namespace cullet {
namespace {

constexpr float kMostDampingRatio = 0.3f;  // section 8 of the note
// Of a spring given by hand: a steel bar of 1 m2 and 1 m has 2e11 N/m, and k L over the least length is finite.
constexpr float kLongestGiven = 1e6f, kStiffestGiven = 1e12f;  // m, N/m
constexpr uint32_t kSpareSlots = 1;  // a pack: a split gives a vertex at most one neighbour more

Result<void> check(const ShellRows& state, Row<Structures> shell, const SpringSettings& s) {
    const auto refuse = [](const char* what, float value, const char* range) {
        return Error{std::string("springs: ") + what + " is " + std::to_string(value) + ", not " + range +
                     ". Give a value in that range."};
    };
    const auto is_in = [](float value, float low, float high) { return value >= low && value <= high; };
    if (!is_in(s.young_modulus, 0, 1e13f)) return refuse("young_modulus", s.young_modulus, "0 to 1e13 Pa");
    if (!is_in(s.damping_ratio, 0, kMostDampingRatio)) return refuse("damping_ratio", s.damping_ratio, "0 to 0.3");
    if (s.length_factor < 0 || s.length_factor > 0)
        if (!is_in(s.length_factor, 0.577f, kMostLengthFactor))
            return refuse("length_factor", s.length_factor, "0 or 0.577 to 5");
    if (!is_in(s.length_factor, 0, kMostLengthFactor)) return refuse("length_factor", s.length_factor, "0 to 5");
    if (!is_in(s.area_energy, 0, 100)) return refuse("area_energy", s.area_energy, "0 to 100");
    if (!is_in(s.volume_energy, 0, 100)) return refuse("volume_energy", s.volume_energy, "0 to 100");
    if (!is_in(s.spare, 0, 4)) return refuse("spare", s.spare, "0 to 4");
    if (!is_in(s.time_step, 0, 1)) return refuse("time_step", s.time_step, "0 to 1 s");
    if (static_cast<uint8_t>(s.layout) > static_cast<uint8_t>(SpringLayout::Crossed))
        return refuse("layout", static_cast<float>(s.layout), "0 to 2");
    if (springs_of(state, shell).exists())
        return Error{"springs: shell " + std::to_string(shell.index) + " has springs already. Release them first."};
    return {};
}

void keep_settings(ShellRows& state, Row<ShellSprings> row, Row<Structures> shell, const SpringSettings& s) {
    ShellSprings& own = state.shell_springs;
    own.layout[row] = static_cast<uint8_t>(s.layout);
    own.young_modulus[row] =
        s.young_modulus > 0 ? s.young_modulus : state.materials.young_modulus[state.structures.material[shell]];
    own.damping_ratio[row] = s.damping_ratio;
    own.length_factor[row] = s.layout == SpringLayout::OneLayer ? 1 : length_factor_of(state, shell, s.length_factor);
    own.area_energy[row] = s.area_energy;
    own.volume_energy[row] = s.layout == SpringLayout::OneLayer ? 0 : s.volume_energy;
    own.keeps_lengths[row] = s.is_slender ? kIsSlender : 0;
    own.time_step[row] = 1;  // until it is known: damping stands per second
    own.packs[row].count = own.packs[row].capacity;
    own.twins[row].count = own.twins[row].capacity;
}

bool owns_edge(const ShellView& shell, uint32_t e, uint32_t k) {
    const Elements& elements = shell.state.elements;
    if (elements.flags[shell.element(e)] & kDead) return false;
    const uint32_t other = elements.neighbour[shell.element(e)][k];
    return other == kNone || other > e;
}

/// A row a spring, by rising element and edge.
void list_edges(const SpringView& view) {
    ShellRows& state = view.state;
    const ShellView& shell = view.shell;
    state.shell_springs.edges[view.row].count = shell.element_count();
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        state.element_springs.spring[view.edges(e)] = {kNone, kNone, kNone};
    uint32_t next = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (uint32_t k = 0; k < 3; ++k) {
            if (!owns_edge(shell, e, k)) continue;
            name_spring(view, e, k, state.elements.neighbour[shell.element(e)][k], next++);
        }
    state.shell_springs.springs[view.row].count = next;
    if (view.has_layers()) state.shell_springs.layers[view.row].count = next;
}

uint32_t count_edges(const ShellView& shell) {
    uint32_t count = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (uint32_t k = 0; k < 3; ++k) count += owns_edge(shell, e, k);
    return count;
}

/// Slots of all packs, with their spare, and an eighth at the end for packs that outgrow theirs.
uint32_t count_slots(const ShellView& shell) {
    uint32_t sum = 0;
    for (uint32_t first = 0; first < shell.vertices().capacity; first += kLanes) {
        uint32_t most = first < shell.vertex_count() ? 0 : 6;  // rows to come
        for (uint32_t v = first; v < std::min(first + kLanes, shell.vertex_count()); ++v) {
            Ring ring;
            walk_ring(shell, v, ring);
            most = std::max(most, ring.count + !ring.is_closed);
        }
        sum += most + kSpareSlots;
    }
    return sum + sum / 8 + 16;
}

template <class ListOf>
void lay_packs(const SpringView& view, ListOf&& list_of) {
    SpringPacks& packs = view.state.spring_packs;
    Range& slots = view.own().slots[view.row];
    for (uint32_t p = 0; p < view.pack_count(); ++p) {
        VertexSprings lists[kLanes];
        for (uint32_t k = 0; k < kLanes; ++k) list_of(p * kLanes + k, lists[k]);
        const uint32_t row = view.pack(p);
        uint32_t room = slots_needed(lists) + kSpareSlots;
        if (p * kLanes >= view.shell.vertex_count()) room = 6 + kSpareSlots;
        room = std::min(room, slots.capacity - slots.count);
        packs.first_slot[row] = slots.count;
        packs.slot_capacity[row] = static_cast<uint16_t>(room);
        slots.count += room;
        write_pack(view, p, lists);
    }
    if (view.has_layers()) view.own().layer_slots[view.row].count = slots.count;
}

void finish(const SpringView& view, const SpringSettings& settings) {
    const float step = settings.time_step > 0 ? settings.time_step : stable_spring_step(view);
    set_spring_step(view, step < 1 ? step : 1);
    for (uint32_t s = 0; s < view.spring_count(); ++s)
        view.own().no_lengths[view.row] += !(view.state.springs.rest_length[view.spring(s)] > 0);
}

Error no_room(const char* limit) {
    return Error{std::string("springs: no room for them. Raise ") + limit + "."};
}

}  // namespace

float length_factor_of(const ShellRows& state, Row<Structures> shell, float wanted) {
    const float h = state.shells.thickness[state.shell_of(shell)],
                natural = h > 0 ? state.shells.mean_edge[state.shell_of(shell)] / h : 1;
    return std::clamp(wanted > 0 ? wanted : natural, kLeastLengthFactor, kMostLengthFactor);
}

Result<Row<ShellSprings>> give_springs(ShellRows& state, Row<Structures> shell_row, const SpringSettings& settings) {
    if (const Result<void> valid = check(state, shell_row, settings); !valid) return Error{valid.error()};
    const ShellView shell(state, shell_row);
    SpringRoom room;
    const uint32_t edges = count_edges(shell);
    const auto spare = [&](uint32_t rows) { return static_cast<uint32_t>(settings.spare * static_cast<float>(rows)); };
    room.springs = edges + edges / 8 + 16 + spare(edges);
    room.elements = shell.elements().capacity;
    room.vertices = shell.vertices().capacity;
    room.slots = count_slots(shell);
    room.slots += spare(room.slots);
    room.has_layers = settings.layout != SpringLayout::OneLayer;
    const char* full = "";
    const Row<ShellSprings> row = make_springs(state, shell_row, room, &full);
    if (!row.exists()) return no_room(full);
    keep_settings(state, row, shell_row, settings);
    const SpringView view(state, row);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) weigh_points(view, v);
    list_edges(view);
    for (uint32_t s = 0; s < view.spring_count(); ++s) measure_spring(view, s, true);
    if (view.has_layers())
        for (uint32_t v = 0; v < shell.vertex_count(); ++v) measure_twin(view, v, true);
    for (uint32_t s = 0; s < view.spring_count(); ++s) {
        state.springs.length[view.spring(s)] = state.springs.rest_length[view.spring(s)];
        if (view.has_layers())
            state.layer_springs.length[view.layer(s)] = state.layer_springs.inner_length[view.layer(s)];
    }
    lay_packs(view, [&](uint32_t v, VertexSprings& list) { collect_springs(view, v, list); });
    finish(view, settings);
    return row;
}

Result<Row<ShellSprings>> give_springs(ShellRows& state, Row<Structures> shell_row, std::span<const GivenSpring> given,
                                       const SpringSettings& settings) {
    if (const Result<void> valid = check(state, shell_row, settings); !valid) return Error{valid.error()};
    const ShellView shell(state, shell_row);
    std::vector<uint32_t> first(shell.vertices().capacity + kLanes + 1, 0);  // counts, then where each list begins
    const auto refuse = [](size_t s, const std::string& what) {
        return Error{"springs: spring " + std::to_string(s) + " " + what};
    };
    if (settings.layout != SpringLayout::OneLayer)
        return Error{"springs: springs given by hand have one layer. Ask for OneLayer."};
    for (size_t s = 0; s < given.size(); ++s) {
        const GivenSpring& g = given[s];
        if (g.a >= shell.vertex_count() || g.b >= shell.vertex_count() || g.a == g.b)
            return refuse(s, "joins vertices " + std::to_string(g.a) + " and " + std::to_string(g.b) + " of " +
                                 std::to_string(shell.vertex_count()) + ". Join two that there are.");
        if (!(g.rest_length >= 0 && g.rest_length <= kLongestGiven && g.stiffness >= 0 &&
              g.stiffness <= kStiffestGiven))
            return refuse(s, "has rest length " + std::to_string(g.rest_length) + " m and stiffness " +
                                 std::to_string(g.stiffness) + " N/m. Give 0 to 1e6 and 0 to 1e12.");
        for (const uint32_t v : {g.a, g.b})
            if (++first[v + 1] > std::size(VertexSprings{}.spring))
                return refuse(s, "is one too many at vertex " + std::to_string(v) + ". Give at most 65 at one.");
    }
    SpringRoom room;
    room.springs = static_cast<uint32_t>(given.size());
    room.vertices = shell.vertices().capacity;
    for (uint32_t p = 0; p < room.vertices; p += kLanes) {
        uint32_t most = 6;
        for (uint32_t k = 0; k < kLanes; ++k) most = std::max(most, first[p + k + 1]);
        room.slots += most + kSpareSlots;
    }
    for (size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    std::vector<uint32_t> springs_at(first.back()), next(first);
    for (uint32_t s = 0; s < given.size(); ++s) springs_at[next[given[s].a]++] = s, springs_at[next[given[s].b]++] = s;
    const char* full = "";
    const Row<ShellSprings> row = make_springs(state, shell_row, room, &full);
    if (!row.exists()) return no_room(full);
    keep_settings(state, row, shell_row, settings);
    const SpringView view(state, row);
    state.shell_springs.springs[row].count = room.springs;
    for (uint32_t s = 0; s < room.springs; ++s) {
        Springs& springs = state.springs;
        const uint32_t at = view.spring(s);
        springs.a[at] = given[s].a, springs.b[at] = given[s].b;
        springs.element[at] = kNone;
        springs.rest_length[at] = springs.plastic_length[at] = springs.length[at] = given[s].rest_length;
        springs.stiffness[at] = given[s].stiffness;
        springs.can_crack[at] = 1;
        springs.place[at] = {kNone, kNone};
        const auto mass = [&](uint32_t v) { return state.vertices.mass[shell.vertex(v)]; };
        const double ma = mass(given[s].a), mb = mass(given[s].b), sum = ma + mb;
        springs.damping[at] = static_cast<float>(2 * double{settings.damping_ratio} *
                                                 std::sqrt(given[s].stiffness * (sum > 0 ? ma * mb / sum : 0)));
    }
    lay_packs(view, [&](uint32_t v, VertexSprings& list) {
        list.count = first[v + 1] - first[v];
        std::copy_n(springs_at.begin() + first[v], list.count, list.spring);
    });
    finish(view, settings);
    return row;
}

}  // namespace cullet
