#include "systems/models/thick_shell/springs/rebuild_springs.hpp"

#include <algorithm>

#include "systems/models/thick_shell/springs/carry_flow.hpp"
#include "systems/models/thick_shell/springs/edge_stiffness.hpp"
#include "systems/models/thick_shell/springs/spring_lists.hpp"
#include "systems/structures/shell/elements_at.hpp"

namespace cullet {
namespace {

/// Rising rows, each once; all rows of [0, end) when there are too many to list.
class RowSet {
 public:
    void add(uint32_t row) {
        uint32_t* const place = std::lower_bound(rows_, rows_ + count_, row);
        if (is_all_ || (place != rows_ + count_ && *place == row)) return;
        if (count_ == kMost) {
            is_all_ = true;
            return;
        }
        std::copy_backward(place, rows_ + count_, rows_ + count_ + 1);
        *place = row;
        ++count_;
    }
    void add_all() { is_all_ = true; }
    bool is_all() const { return is_all_; }
    uint32_t count(uint32_t end) const { return is_all_ ? end : count_; }
    bool has(uint32_t row) const { return is_all_ || std::binary_search(rows_, rows_ + count_, row); }
    template <class F>
    void for_each(uint32_t end, F&& f) const {
        const uint32_t count = is_all_ ? end : count_;
        for (uint32_t i = 0; i < count; ++i) f(is_all_ ? i : rows_[i]);
    }

 private:
    static constexpr uint32_t kMost = 4096;
    uint32_t rows_[kMost], count_ = 0;
    bool is_all_ = false;
};

constexpr size_t kMostTouched = 512;

struct Sets {
    RowSet vertices, elements;
    /// Packs whose lists, or whose neighbours' names, change: of touched vertices, and of springs that are made or get
    /// other ends. They are written anew; others keep their places.
    RowSet written;
    VertexSprings lists[kLanes];  // of one pack
};

void gather_sets(const SpringView& view, std::span<const uint32_t> touched, Sets& sets) {
    if (touched.size() > kMostTouched) return sets.vertices.add_all(), sets.elements.add_all(), sets.written.add_all();
    for (const uint32_t v : touched) {
        sets.vertices.add(v);
        sets.written.add(v / kLanes);
        for_each_element_at(view.shell, v, [&](uint32_t e) { sets.elements.add(e); });
    }
    if (sets.elements.is_all()) sets.vertices.add_all(), sets.written.add_all();
}

bool is_dead(const SpringView& view, uint32_t e) {
    return view.state.elements.flags[view.shell.element(e)] & kDead;
}

/// Edge of `other` that looks at `e`, or 3.
uint32_t edge_to(const SpringView& view, uint32_t other, uint32_t e) {
    const auto& neighbour = view.state.elements.neighbour[view.shell.element(other)];
    uint32_t k = 0;
    while (k < 3 && neighbour[k] != e) ++k;
    return k;
}

/// What the spring of edge k of element e has to become.
enum class Fate : uint8_t { Stays, IsCutOff, IsMissing, IsTheOthers };

struct EdgeState {
    Fate fate;
    uint32_t spring, other, other_edge;
};

bool is_asleep(const SpringView& view, uint32_t e) {
    return view.state.element_springs.spring[view.edges(e)][0] == kAsleepSpring;
}

// Of an edge with two elements the lower decides. A cut edge's two elements name the same spring: it stays with the one
// that owns it, or with that one's neighbour.
EdgeState look_at(const SpringView& view, uint32_t e, uint32_t k) {
    const ShellRows& state = view.state;
    const uint32_t spring = state.element_springs.spring[view.edges(e)][k];
    uint32_t other = state.elements.neighbour[view.shell.element(e)][k];
    if (is_asleep(view, e)) return {Fate::IsTheOthers, kNone, kNone, 3};
    if (other != kNone && is_asleep(view, other)) other = kNone;
    const uint32_t other_edge = other == kNone ? 3 : edge_to(view, other, e);
    if (other != kNone && other < e) return {Fate::IsTheOthers, spring, other, other_edge};
    if (spring == kNone) {
        const uint32_t theirs = other == kNone ? kNone : state.element_springs.spring[view.edges(other)][other_edge];
        return {theirs == kNone ? Fate::IsMissing : Fate::Stays, theirs, other, other_edge};
    }
    const uint32_t owner = state.springs.element[view.spring(spring)];
    return {owner == e || owner == other || owner == kNone ? Fate::Stays : Fate::IsCutOff, spring, other, other_edge};
}

/// A point of a split vertex, or of a new one, that has no twin yet.
bool lacks_twin(const SpringView& view, uint32_t v) {
    return view.has_layers() && !(view.state.twins.mass_share[view.twin(v)] > 0);
}

// What stands between the layers differs by side.
void turn(const SpringView& view, uint32_t s) {
    Springs& springs = view.state.springs;
    const uint32_t row = view.spring(s);
    std::swap(springs.a[row], springs.b[row]);
    std::swap(springs.place[row][0], springs.place[row][1]);
    if (!view.has_layers()) return;
    auto& cross = view.state.layer_springs.cross_length[view.layer(s)];
    std::swap(cross[0], cross[1]);
}

// a and b are the first and the second corner of the owner's edge. True: they were others.
bool set_ends(const SpringView& view, uint32_t s, uint32_t from, uint32_t to, bool is_turned, RowSet& written) {
    Springs& springs = view.state.springs;
    const uint32_t row = view.spring(s);
    if (is_turned) turn(view, s);
    bool is_changed = false;
    const auto follow = [&](uint32_t& end, uint32_t now) {
        if (end != now && end != kNone && lacks_twin(view, now) && !lacks_twin(view, end))
            view.state.twins.copy_rows(view.state.twins, view.twin(end), view.twin(now), 1);
        if (end != now && end != kNone) written.add(end / kLanes);
        is_changed = is_changed || end != now;
        end = now;
    };
    follow(springs.a[row], from);
    follow(springs.b[row], to);
    return is_changed;
}

/// A row that no element has: without ends, stiffness and length.
void clear_spring(const SpringView& view, uint32_t s) {
    ShellRows& state = view.state;
    const uint32_t row = view.spring(s);
    state.springs.clear_rows(row, 1);
    if (view.has_layers()) state.layer_springs.clear_rows(view.layer(s), 1);
    state.springs.a[row] = state.springs.b[row] = state.springs.element[row] = kNone;
    state.springs.can_crack[row] = 1;
    state.springs.place[row] = {kNone, kNone};
}

uint32_t new_spring(const SpringView& view, const EdgeState& edge) {
    ShellRows& state = view.state;
    const uint32_t s = view.own().springs[view.row].count++;
    if (view.has_layers()) ++view.own().layers[view.row].count;
    clear_spring(view, s);
    if (edge.fate != Fate::IsCutOff) return s;
    state.springs.copy_rows(state.springs, view.spring(edge.spring), view.spring(s), 1);
    if (view.has_layers())
        state.layer_springs.copy_rows(state.layer_springs, view.layer(edge.spring), view.layer(s), 1);
    return s;
}

void take_springs(const SpringView& view, Sets& sets) {
    ShellRows& state = view.state;
    sets.elements.for_each(view.shell.element_count(), [&](uint32_t e) {
        for (uint32_t k = 0; k < 3 && !is_dead(view, e); ++k) {
            const EdgeState edge = look_at(view, e, k);
            if (edge.fate == Fate::IsTheOthers) continue;
            const uint32_t s = edge.fate == Fate::Stays ? edge.spring : new_spring(view, edge);
            const auto& corner = state.elements.corner[view.shell.element(e)];
            const uint32_t owner = state.springs.element[view.spring(s)];
            const uint32_t from = corner[k], to = corner[(k + 1) % 3];
            const bool has_other_ends =
                set_ends(view, s, from, to, edge.fate != Fate::IsMissing && owner != e, sets.written);
            if (has_other_ends || edge.fate != Fate::Stays) {
                sets.written.add(from / kLanes);
                sets.written.add(to / kLanes);
            }
            state.springs.element[view.spring(s)] = e;
            state.element_springs.spring[view.edges(e)][k] = s;
            if (edge.other != kNone) state.element_springs.spring[view.edges(edge.other)][edge.other_edge] = s;
        }
    });
}

void measure(const SpringView& view, const Sets& sets) {
    ShellRows& state = view.state;
    const uint32_t vertices = view.shell.vertex_count();
    sets.vertices.for_each(vertices, [&](uint32_t v) {
        const bool lacked = lacks_twin(view, v);
        weigh_points(view, v);
        CULLET_ASSERT(!lacked || lacks_twin(view, v), "vertex %u has no inner point: insert_twin makes it", v);
        (void)lacked;
    });
    sets.elements.for_each(view.shell.element_count(), [&](uint32_t e) {
        for (const uint32_t s : state.element_springs.spring[view.edges(e)])
            if (s < kAsleepSpring && state.springs.element[view.spring(s)] == e) {
                const bool is_new = !(state.springs.rest_length[view.spring(s)] > 0);
                measure_spring(view, s, is_new);
                if (is_new && carry_flow(view, s)) measure_spring(view, s, false);
            }
    });
    if (!view.has_layers()) return;
    sets.vertices.for_each(vertices,
                           [&](uint32_t v) { measure_twin(view, v, !(state.twins.inverse_rest[view.twin(v)] > 0)); });
}

void collect_pack(const SpringView& view, uint32_t pack, VertexSprings (&lists)[kLanes]) {
    for (uint32_t k = 0; k < kLanes; ++k) collect_springs(view, pack * kLanes + k, lists[k]);
}

/// Of the pack's vertices by their rings, whether or not the springs are there yet.
uint32_t longest_list(const SpringView& view, uint32_t pack) {
    uint32_t most = 0;
    for (uint32_t v = pack * kLanes; v < std::min((pack + 1) * kLanes, view.shell.vertex_count()); ++v) {
        uint32_t elements = 0;
        const bool is_closed = for_each_element_at(view.shell, v, [&](uint32_t) { ++elements; });
        most = std::max(most, elements + (elements > 0 && !is_closed));
    }
    return most;
}

bool has_room(const SpringView& view, const Sets& sets) {
    const Range of_springs = view.own().springs[view.row], of_slots = view.own().slots[view.row];
    // As many as there could be at most are seldom too many, and looking how many there will be takes as long as making
    // them.
    const uint32_t most_springs = 3 * sets.elements.count(view.shell.element_count()),
                   most_slots = (kMostRing + 2) * 3 * sets.elements.count(view.shell.element_count());
    if (of_springs.count + most_springs <= of_springs.capacity && of_slots.count + most_slots <= of_slots.capacity)
        return true;
    uint32_t springs = 0, slots = 0;
    sets.elements.for_each(view.shell.element_count(), [&](uint32_t e) {
        for (uint32_t k = 0; k < 3 && !is_dead(view, e); ++k) {
            const Fate fate = look_at(view, e, k).fate;
            springs += fate == Fate::IsCutOff || fate == Fate::IsMissing;
        }
    });
    const Scratch<RowSet> found(view.state.scratch);
    RowSet& packs = *found;
    sets.elements.for_each(view.shell.element_count(), [&](uint32_t e) {
        for (const uint32_t corner : view.state.elements.corner[view.shell.element(e)]) packs.add(corner / kLanes);
    });
    packs.for_each(view.pack_count(), [&](uint32_t p) {
        const uint32_t needed = longest_list(view, p);
        if (needed > view.state.spring_packs.slot_capacity[view.pack(p)]) slots += needed + 1;
    });
    return of_springs.count + springs <= of_springs.capacity && of_slots.count + slots <= of_slots.capacity;
}

/// Of all springs at the vertex. In no order, and those of two elements twice: nothing is summed.
void remember_lengths_at(const SpringView& view, uint32_t vertex) {
    for_each_element_at(view.shell, vertex, [&](uint32_t e) {
        const uint32_t k = corner_of(view.shell, e, vertex);
        if (k == 3) return;
        const std::array<uint32_t, 3>& springs = view.state.element_springs.spring[view.edges(e)];
        for (const uint32_t j : {k, (k + 2) % 3})
            if (springs[j] < kAsleepSpring) remember_length(view, springs[j]);
    });
}

/// What measure() found, in the packs that keep their lists. Both ends of new springs are in packs that are written.
void tell_other_packs(const SpringView& view, const Sets& sets) {
    const ShellRows& state = view.state;
    sets.elements.for_each(view.shell.element_count(), [&](uint32_t e) {
        for (const uint32_t s : state.element_springs.spring[view.edges(e)]) {
            if (s >= kAsleepSpring || state.springs.element[view.spring(s)] != e) continue;
            const bool has_a = sets.written.has(state.springs.a[view.spring(s)] / kLanes),
                       has_b = sets.written.has(state.springs.b[view.spring(s)] / kLanes);
            if (!has_a || !has_b) write_spring(view, s);
        }
    });
}

/// A pack that has outgrown its slots gets new ones at the end of the shell's.
void make_pack_room(const SpringView& view, uint32_t pack, uint32_t needed) {
    SpringPacks& packs = view.state.spring_packs;
    const uint32_t row = view.pack(pack);
    if (needed <= packs.slot_capacity[row]) return;
    Range& slots = view.own().slots[view.row];
    packs.first_slot[row] = slots.count;
    packs.slot_capacity[row] = static_cast<uint16_t>(needed + 1);
    slots.count += needed + 1;
    if (view.has_layers()) view.own().layer_slots[view.row].count = slots.count;
}

/// Elements that were added since have no springs yet.
void list_new_elements(const SpringView& view) {
    Range& edges = view.own().edges[view.row];
    CULLET_ASSERT(view.shell.element_count() <= edges.capacity, "%u elements, room for the springs of %u",
                  view.shell.element_count(), edges.capacity);
    for (; edges.count < view.shell.element_count(); ++edges.count) {
        view.state.element_springs.spring[view.edges(edges.count)] = {kNone, kNone, kNone};
        view.state.element_springs.flow[view.edges(edges.count)] = {};
    }
}

}  // namespace

bool rebuild_springs(const SpringView& view, std::span<const uint32_t> touched) {
    const Scratch<Sets> work(view.state.scratch);
    Sets& sets = *work;
    list_new_elements(view);
    gather_sets(view, touched, sets);
    if (!has_room(view, sets)) return false;
    take_springs(view, sets);
    measure(view, sets);
    // All lengths are read before any slot is written: packs share springs.
    sets.written.for_each(view.pack_count(), [&](uint32_t p) {
        for (uint32_t v = p * kLanes; v < std::min((p + 1) * kLanes, view.shell.vertex_count()); ++v)
            remember_lengths_at(view, v);
    });
    sets.written.for_each(view.pack_count(), [&](uint32_t p) {
        collect_pack(view, p, sets.lists);
        make_pack_room(view, p, slots_needed(sets.lists));
        write_pack(view, p, sets.lists);
    });
    if (!sets.written.is_all()) tell_other_packs(view, sets);
    return true;
}

// The spring goes to the other element that has the edge, turned as it sees it; if there is none, nobody has it.
void forget_springs(const SpringView& view, uint32_t element) {
    ShellRows& state = view.state;
    list_new_elements(view);
    remember_flow(view, element);
    for (uint32_t& entry : state.element_springs.spring[view.edges(element)]) {
        const uint32_t s = entry;
        entry = kNone;
        if (s >= view.spring_count() || state.springs.element[view.spring(s)] != element) continue;
        const uint32_t a = state.springs.a[view.spring(s)], b = state.springs.b[view.spring(s)];
        Ring ring;
        walk_ring(view.shell, a, ring);
        bool is_taken = false;
        for (uint32_t i = 0; i < ring.count && !is_taken; ++i) {
            const uint32_t other = ring.element[i], k = ring.corner[i];
            const auto& corner = state.elements.corner[view.shell.element(other)];
            const auto& springs = state.element_springs.spring[view.edges(other)];
            const bool runs_from_a = springs[k] == s && corner[(k + 1) % 3] == b;
            const bool runs_to_a = springs[(k + 2) % 3] == s && corner[(k + 2) % 3] == b;
            if (!runs_from_a && !runs_to_a) continue;
            is_taken = true;
            state.springs.element[view.spring(s)] = other;
            if (runs_to_a) turn(view, s);
        }
        if (!is_taken) clear_spring(view, s);
    }
}

void drop_dead_springs(const SpringView& view) {
    for (uint32_t s = 0; s < view.spring_count(); ++s) {
        const uint32_t element = view.state.springs.element[view.spring(s)];
        if (element != kNone && is_dead(view, element)) clear_spring(view, s);
    }
}

void insert_twin(const SpringView& view, uint32_t p, uint32_t q, uint32_t vertex, float tau) {
    Twins& twins = view.state.twins;
    const uint32_t from = view.twin(p), to = view.twin(q), row = view.twin(vertex);
    const auto between = [&](Vec3 a, Vec3 b) { return a + tau * (b - a); };
    twins.clear_rows(row, 1);
    weigh_points(view, vertex);
    twins.velocity.set(row, between(twins.velocity[from], twins.velocity[to]));
    view.place_twin(vertex, between(view.twin_position(p), view.twin_position(q)));
    twins.through.set(row, between(twins.through[from], twins.through[to]));
    twins.length[row] = length(view.twin_position(vertex) - view.position(vertex));
}

}  // namespace cullet
