#include <bit>

#include "systems/models/thick_shell/quick/region.hpp"
#include "systems/models/thick_shell/springs/edge_stiffness.hpp"
#include "systems/models/thick_shell/springs/give_springs.hpp"
#include "systems/models/thick_shell/springs/spring_lists.hpp"
#include "systems/structures/shell/elements_at.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

constexpr float kDampingRatio = 0.05f;
constexpr uint32_t kSpareSlots = 1;  // a pack, as give_springs has it
/// Of a vertex's stiffness over mass, over the region's mean: what is stiffer is softened to it. The step is 0.6 of the
/// mean's bound, so at 1.8 it is 0.8 of the bound. Doubled, runs blow up; 1 softens half of an uneven mesh.
constexpr double kMostRatio = 1.8;

struct Layout {
    RunRows& state;
    const ShellView& shell;
    uint32_t first_element = kNone;  // awake ones, chained through Elements.next

    bool is_awake(uint32_t e) const { return state.elements.copy[shell.element(e)] != 0; }
    /// By the vertices' marks: what chain() writes into Elements.copy.
    bool has_awake_corner(uint32_t row) const {
        if (state.elements.flags[row] & kDead) return false;
        const auto& c = state.elements.corner[row];
        const auto is_marked = [&](uint32_t v) { return state.vertices.copy[shell.vertex(v)] == kAwakeMark; };
        return is_marked(c[0]) || is_marked(c[1]) || is_marked(c[2]);
    }
    void chain() {
        uint32_t last = kNone;
        for (uint32_t e = 0; e < shell.element_count(); ++e) {
            const bool is_chained = has_awake_corner(shell.element(e));
            state.elements.copy[shell.element(e)] = is_chained;
            if (!is_chained) continue;
            state.elements.next[shell.element(e)] = kNone;
            (last == kNone ? first_element : state.elements.next[shell.element(last)]) = e;
            last = e;
        }
    }
    template <class F>
    void for_each_element(F&& f) const {
        for (uint32_t e = first_element; e != kNone; e = state.elements.next[shell.element(e)]) f(e);
    }
    /// The edge's spring belongs to the lower of its awake elements.
    bool owns(uint32_t e, uint32_t k) const {
        const uint32_t other = state.elements.neighbour[shell.element(e)][k];
        return other == kNone || other > e || !is_awake(other);
    }
    uint32_t count_edges() const {
        uint32_t count = 0;
        for_each_element([&](uint32_t e) {
            for (uint32_t k = 0; k < 3; ++k) count += owns(e, k);
        });
        return count;
    }
};

/// How many edges each vertex has, asleep or not: in Vertices.copy, whose marks chain() was the last to read. Each of
/// its elements brings one, and a border one more: nobody walks round vertices.
void count_edges_at_vertices(const ShellView& shell) {
    ShellRows& state = shell.state;
    uint32_t* const edges = state.vertices.copy.data() + shell.vertex(0);
    std::fill_n(edges, shell.vertex_count(), 0u);
    for (uint32_t row = shell.element(0); row < shell.element(shell.element_count()); ++row) {
        if (state.elements.flags[row] & kDead) continue;
        const auto &corner = state.elements.corner[row], &neighbour = state.elements.neighbour[row];
        for (uint32_t k = 0; k < 3; ++k) edges[corner[k]] += neighbour[k] == kNone ? 2 : 1;
    }
}

uint32_t slots_of(const ShellView& shell, uint32_t pack) {
    uint32_t most = 0;
    for (uint32_t v = pack * kLanes; v < std::min((pack + 1) * kLanes, shell.vertex_count()); ++v)
        most = std::max(most, shell.state.vertices.copy[shell.vertex(v)]);
    return most + kSpareSlots;
}

/// slots_of the region's i-th pack, from room_for to place_packs: in Elements.next_in_cell, which has more rows than
/// that.
uint32_t& slots_kept(const ShellView& shell, uint32_t i) {
    return shell.state.elements.next_in_cell[shell.element(0) + i];
}

/// A vertex put on an edge brings four springs, the copy of a split one an edge: the spare vertices bound both. A pack
/// that outgrows its slots moves to the end; copies need packs of their own.
SpringRoom room_for(const Layout& layout, Row<Tasks> task, uint32_t edges, bool has_layers) {
    RunRows& state = layout.state;
    const MarkedPacks& packs = state.marked_packs;
    SpringRoom room;
    const uint32_t spare = std::min(layout.shell.vertices().capacity - layout.shell.vertex_count(),
                                    2 * kLanes * state.hidden_runs.pack_count[task]);
    room.springs = edges + 4 * spare + 64;
    room.elements = layout.shell.elements().capacity;
    room.vertices = layout.shell.vertices().capacity;
    room.has_layers = has_layers;
    room.clears_lists = false;
    uint32_t slots = 0;
    const uint32_t count = state.hidden_runs.pack_count[task];
    count_edges_at_vertices(layout.shell);
    for (uint32_t i = 0; i < count; ++i)
        slots += slots_kept(layout.shell, i) = slots_of(layout.shell, packs.pack[task * kMostMarkedPacks + i]);
    room.slots = 2 * slots + 6 * spare + 64;
    return room;
}

void list_edges(const Layout& layout, const SpringView& view) {
    ShellRows& state = view.state;
    const ShellView& shell = view.shell;
    state.shell_springs.edges[view.row].count = shell.element_count();
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        state.element_springs.spring[view.edges(e)] = {kAsleepSpring, kAsleepSpring, kAsleepSpring};
    layout.for_each_element([&](uint32_t e) { state.element_springs.spring[view.edges(e)] = {kNone, kNone, kNone}; });
    uint32_t next = 0;
    layout.for_each_element([&](uint32_t e) {
        for (uint32_t k = 0; k < 3; ++k) {
            if (!layout.owns(e, k)) continue;
            const uint32_t other = state.elements.neighbour[shell.element(e)][k];
            name_spring(view, e, k, other != kNone && layout.is_awake(other) ? other : kNone, next++);
        }
    });
    state.shell_springs.springs[view.row].count = next;
    if (view.has_layers()) state.shell_springs.layers[view.row].count = next;
}

double stiffness_ratio(const SpringView& view, uint32_t v, const VertexSprings& list) {
    const ShellRows& state = view.state;
    double outer = 0, inner = 0, shared = 0;
    for (uint32_t i = 0; i < list.count; ++i) {
        outer += 2 * double{state.springs.stiffness[view.spring(list.spring[i])]};
        if (!view.has_layers()) continue;
        const uint32_t layer = view.layer(list.spring[i]);
        const LayerSprings& layers = state.layer_springs;
        inner += 2 * double{layers.inner_stiffness[layer]};
        shared += layers.mid_stiffness[layer];
        shared += (view.layout() == SpringLayout::Sandwich ? 4 : 2) * double{layers.cross_stiffness[layer]};
    }
    if (!view.has_layers()) return outer * state.vertices.inverse_mass[view.shell.vertex(v)];
    const uint32_t twin = view.twin(v);
    shared += 2 * double{state.twins.stiffness_rest[twin]} * state.twins.inverse_rest[twin];
    return (std::max(outer, inner) + shared) * state.twins.inverse_mass[twin];
}

/// Where each pack's slots are, by its vertices' edges: as many as it needs, and one to spare.
void place_packs(const RegionView& region) {
    RunRows& state = region.state;
    const SpringView& view = region.springs;
    Range& slots = view.own().slots[view.row];
    for (uint32_t i = 0; i < region.pack_count(); ++i) {
        const uint32_t pack = view.pack(state.marked_packs.pack[region.first_row() + i]);
        const uint32_t room = std::min(slots_kept(region.shell, i), slots.capacity - slots.count);
        state.spring_packs.first_slot[pack] = slots.count;
        state.spring_packs.slot_capacity[pack] = static_cast<uint16_t>(room);
        slots.count += room;
    }
    if (view.has_layers()) view.own().layer_slots[view.row].count = slots.count;
}

struct Chunk {
    uint32_t first, end;
};
/// Of MarkedPacks, in the chunk that begins with a row.
Chunk packs_of_chunk(const RegionView& region, uint32_t first_row) {
    return {first_row, std::min(first_row + kRowsPerChunk<MarkedPacks>, region.first_row() + region.pack_count())};
}
/// Of springs: the share of its packs.
Chunk springs_of_chunk(const RegionView& region, uint32_t first_row) {
    const Chunk packs = packs_of_chunk(region, first_row);
    const auto share = [&](uint32_t row) {
        return static_cast<uint32_t>(uint64_t{region.springs.spring_count()} * (row - region.first_row()) /
                                     region.pack_count());
    };
    return {share(packs.first), share(packs.end)};
}

// The strain limit is that of blows on faces, which bend a sheet more than they stretch it. A blow along the sheet
// stretches it at once, by v / c as a bar's end. (Times the root of s here: the run's velocities are true, its c is
// not.) It stretches a wall of one layer by 40 times what a ball on its face does. With the limit of faces its pieces,
// which meet at their rims, broke each other at 2 cm/s. So each contact asks for what its part along the sheet
// stretches at its speed, at most at that of falls that crack the body, as cooking found; the limit is no less. That
// the struck vertex is near a border does not tell: pieces' hulls touch at places whose nearest vertex is well inside a
// face, and balls strike faces beside a border. With several contacts the largest counts, for all of the region.
float limit_along_sheet(const RunRows& state, Row<Tasks> task, const ShellView& shell, float root) {
    const TaskContacts& contacts = state.task_contacts;
    const uint32_t material = state.structures.material[shell.structure];
    const float slowness = std::sqrt(state.materials.density[material] / state.materials.young_modulus[material]);
    float most = 0;
    for (uint32_t c = state.tasks.first_contact[task], end = c + state.tasks.contact_count[task]; c < end; ++c) {
        const float across = dot(contacts.normal[c], state.vertices.inward[shell.vertex(contacts.vertex[c])]);
        const auto speed = std::min(static_cast<float>(std::max(0.0, contacts.striker_speed[c])),
                                    state.structures.first_crack_speed[shell.structure]);
        most = std::max(most, std::sqrt(std::max(0.0f, 1 - across * across)) * speed);
    }
    return root * most * slowness;
}

/// B7: s so that what breaks at eps_f in truth breaks at 2 %, which float positions resolve to a thousandth.
void soften(RunRows& state, Row<Tasks> task, Row<Structures> shell) {
    constexpr float kShownStrain = 0.02f, kShortLoad = 2.0f;  // as kShortLoadFactor of the hidden run
    QuickRuns& runs = state.quick_runs;
    const Materials& materials = state.materials;
    const uint32_t material = state.structures.material[shell];
    const float breaking = kShortLoad * materials.tensile_strength[material] / materials.young_modulus[material];
    const float root = std::max(1.0f, kShownStrain / breaking);
    const float given = runs.strain_limit[task];
    runs.softening[task] = root * root;
    const float limit =
        given > 0 ? std::max(given, limit_along_sheet(state, task, ShellView(state, shell), root)) : breaking * root;
    runs.split_strain[task] = limit * state.tasks.strength_scale[task];
}

}  // namespace

double stiffness_ratio(const SpringView& view, uint32_t v) {
    VertexSprings list;
    collect_springs(view, v, list);
    return stiffness_ratio(view, v, list);
}

namespace {

void soften_spring(const SpringView& view, uint32_t s, float factor) {
    Springs& springs = view.state.springs;
    springs.stiffness[view.spring(s)] *= factor;
    springs.damping[view.spring(s)] *= factor;
    if (view.has_layers()) {
        LayerSprings& layers = view.state.layer_springs;
        const uint32_t layer = view.layer(s);
        for (auto* column :
             {&layers.inner_stiffness, &layers.inner_damping, &layers.mid_stiffness, &layers.cross_stiffness})
            (*column)[layer] *= factor;
    }
    write_spring(view, s);
}

/// What is left of the stiffness at v when its ratio may be no more than `limit`.
void limit_vertex(const SpringView& view, uint32_t v, double limit) {
    VertexSprings list;
    collect_springs(view, v, list);
    const double ratio = stiffness_ratio(view, v, list);
    if (!(ratio > limit)) return;
    const auto factor = static_cast<float>(limit / ratio);
    for (uint32_t i = 0; i < list.count; ++i) soften_spring(view, list.spring[i], factor);
    if (!view.has_layers()) return;
    view.state.twins.stiffness_rest[view.twin(v)] *= factor;
    view.state.twins.damping[view.twin(v)] *= factor;
}

double ratio_limit(const SpringView& view) {
    const double dt = view.own().time_step[view.row];
    return kMostRatio * 0.36 * 4 / (dt * dt);
}

// Until the step is known damping stands per second.
void divide_damping(const RegionView& region, float dt) {
    RunRows& state = region.state;
    const SpringView& view = region.springs;
    const uint32_t slots = view.own().slots[view.row].count;
    const auto divide = [&](auto* slot) {
        for (uint32_t i = 0; i < slots; ++i)
            for (float& damping : slot[i].damping) damping /= dt;
    };
    divide(state.spring_slots.slot.data() + view.slot(0));
    if (!view.has_layers()) return;
    divide(state.layer_slots.slot.data() + view.layer_slot(0));
    region.for_each([&](uint32_t v, bool) { state.twins.damping[view.twin(v)] /= dt; });
}

}  // namespace

// Vertices.copy tells which were looked at: each once, in the order of the list.
void limit_springs(const RegionView& region, std::span<const uint32_t> vertices) {
    constexpr uint32_t kWaits = 1, kDone = 2;
    const SpringView& view = region.springs;
    const ShellView& shell = region.shell;
    Elements& elements = region.state.elements;
    const double limit = ratio_limit(view);
    for (const uint32_t v : vertices)
        for_each_element_at(shell, v, [&](uint32_t e) {
            for (const uint32_t corner : elements.corner[shell.element(e)])
                region.state.vertices.copy[shell.vertex(corner)] = kWaits;
        });
    Ring ring;
    for (const uint32_t v : vertices) {
        walk_ring(shell, v, ring);
        for (uint32_t i = 0; i < ring.count; ++i)
            for (const uint32_t corner : elements.corner[shell.element(ring.element[i])]) {
                uint32_t& mark = region.state.vertices.copy[shell.vertex(corner)];
                if (mark != kDone) limit_vertex(view, corner, limit);
                mark = kDone;
            }
    }
}

bool take_region_springs(RunRows& state, Row<Tasks> task, uint32_t layers, const char** full) {
    const Row<Structures> shell_row = state.tasks.working[task];
    const ShellView shell(state, shell_row);
    QuickRuns& runs = state.quick_runs;
    soften(state, task, shell_row);
    Layout layout{state, shell};
    layout.chain();
    const bool has_layers = layers > 1;
    const Row<ShellSprings> row =
        make_springs(state, shell_row, room_for(layout, task, layout.count_edges(), has_layers), full);
    if (!row.exists()) return false;
    runs.springs[task] = row;
    ShellSprings& own = state.shell_springs;
    own.layout[row] = static_cast<uint8_t>(spring_layout(has_layers, static_cast<LayerLayout>(runs.layout[task])));
    own.young_modulus[row] = state.materials.young_modulus[state.structures.material[shell_row]] / runs.softening[task];
    own.damping_ratio[row] = kDampingRatio;
    own.length_factor[row] = has_layers ? length_factor_of(state, shell_row, runs.length_factor[task]) : 1;
    own.area_energy[row] = runs.area_energy[task];
    own.volume_energy[row] = has_layers ? runs.volume_energy[task] : 0;
    own.time_step[row] = 1;  // until it is known: damping stands per second
    own.packs[row].count = own.packs[row].capacity;
    own.twins[row].count = own.twins[row].capacity;
    const RegionView region(state, task);
    const SpringView& view = region.springs;
    list_edges(layout, view);
    place_packs(region);
    if (has_layers) region.for_each([&](uint32_t v, bool) { weigh_points(view, v); });
    return true;
}

void measure_region_springs(const RegionView& region, uint32_t first_row) {
    RunRows& state = region.state;
    const SpringView& view = region.springs;
    const Chunk springs = springs_of_chunk(region, first_row);
    for (uint32_t s = springs.first; s < springs.end; ++s) {
        measure_spring(view, s, true);
        state.springs.length[view.spring(s)] = state.springs.rest_length[view.spring(s)];
        if (view.has_layers())
            state.layer_springs.length[view.layer(s)] = state.layer_springs.inner_length[view.layer(s)];
    }
}

// Vertices.copy, whose marks are read no more, keeps the vertex's ratio: the bits of a float, 0 of what is held.
void lay_region_springs(const RegionView& region, uint32_t first_row) {
    RunRows& state = region.state;
    const SpringView& view = region.springs;
    const MarkedPacks& packs = state.marked_packs;
    const Chunk rows = packs_of_chunk(region, first_row);
    VertexSprings lists[kLanes];
    for (uint32_t row = rows.first; row < rows.end; ++row) {
        for (uint32_t k = 0; k < kLanes; ++k) {
            const uint32_t v = packs.pack[row] * kLanes + k;
            collect_springs(view, v, lists[k]);
            if (!((packs.awake[row] | packs.held[row]) >> k & 1)) continue;
            if (view.has_layers()) measure_twin(view, v, lists[k], true);
            const double ratio = packs.held[row] >> k & 1 ? 0 : stiffness_ratio(view, v, lists[k]);
            state.vertices.copy[region.shell.vertex(v)] = std::bit_cast<uint32_t>(static_cast<float>(ratio));
        }
        write_pack(view, packs.pack[row], lists);
    }
}

void limit_region_springs(const RegionView& region) {
    const SpringView& view = region.springs;
    const auto ratio_of = [&](uint32_t v) {
        return std::bit_cast<float>(region.state.vertices.copy[region.shell.vertex(v)]);
    };
    double sum = 0;
    uint32_t count = 0;
    region.for_each([&](uint32_t v, bool) {
        sum += ratio_of(v);
        count += ratio_of(v) > 0;
    });
    const double step = count > 0 ? 0.6 * 2 / std::sqrt(sum / count) : 1;
    const auto dt = static_cast<float>(std::min(step, 1.0));
    view.own().time_step[view.row] = dt;
    divide_damping(region, dt);
    // Softening only takes from what the ratios were.
    const double limit = ratio_limit(view);
    constexpr float kRounded = 1.000001f;
    region.for_each([&](uint32_t v, bool) {
        if (kRounded * ratio_of(v) > limit) limit_vertex(view, v, limit);
    });
}

}  // namespace cullet
