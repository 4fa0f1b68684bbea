#include "systems/models/thick_shell/quick/grow_region.hpp"

#include "engine/random.hpp"
#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/models/thick_shell/quick/costs.hpp"
#include "systems/models/thick_shell/quick/quick_loop.hpp"
#include "systems/models/thick_shell/quick/run_on.hpp"
#include "systems/models/thick_shell/quick/strained_edges.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

constexpr uint64_t kEndSeed = 0x71756965636b31;
/// Mean edges that a crack of coarse fracture runs on: pieces are about as wide. The paper's, which do not run on, are
/// slits of two edges that seldom meet: a wall of 823 vertices had 40 of them, and no piece.
constexpr float kCoarseRun = 6;

bool split_edge(Splitting& s, const StrainedEdge& edge) {
    Vertices& vertices = s.state().vertices;
    // An edge that an earlier split of this step took away is none any more.
    Ring ring;
    walk_ring(s.shell(), edge.low, ring);
    bool is_there = false;
    for (uint32_t i = 0; i < ring.count; ++i)
        for (const uint32_t v : s.state().elements.corner[s.shell().element(ring.element[i])])
            is_there = is_there || v == edge.high;
    if (!is_there || vertices.is_start_banned[s.row(edge.low)] || vertices.is_start_banned[s.row(edge.high)])
        return false;
    const bool low_is_tip = s.is_tip(edge.low), high_is_tip = s.is_tip(edge.high);
    bool is_low = (Random{kEndSeed}.bits(edge.low, edge.high) & 1) != 0;
    if (low_is_tip != high_is_tip) is_low = low_is_tip;
    const uint32_t vertex = is_low ? edge.low : edge.high, other = is_low ? edge.high : edge.low;
    const Vec3 along = s.rest(other) - s.rest(vertex);
    if (!(dot(along, along) > 0)) return false;
    const Vec3 normal = normalised(along);
    const bool was_cracked = vertices.crack[s.row(vertex)] != static_cast<uint8_t>(CrackState::None);
    const uint32_t first_copy = s.shell().vertex_count();
    const uint32_t old_root = vertices.crack_start[s.row(vertex)];
    const uint32_t root = was_cracked && old_root != kNone ? old_root : vertex;
    const Split split = split_along(s, vertex, normal, root);
    if (!split.is_cut) return false;
    vertices.crack_start[s.row(vertex)] = root;
    s.starts += !was_cracked;
    // Large as well: its cracks are to be few and long, and without it the patch crumbles into slivers.
    if (s.kind != FractureKind::Fine) close_neighbours(s, vertex, split.ends, first_copy);
    if (s.run_length > 0)
        for (uint32_t i = 0; i < split.ends.count && !s.is_full; ++i) {
            if (!split.ends.is_interior[i]) continue;
            const Vec3 way = normalised(s.rest(split.ends.end[i]) - s.rest(vertex));
            run_on(s, split.ends.end[i], way, normal, root);
        }
    return true;
}

/// Asked at each step: what material_traits gathers beside it is a microsecond and a half.
FractureKind kind_of(const RunRows& state, Row<Tasks> task) {
    const Row<Materials> material = state.structures.material[state.tasks.working[task]];
    if (material < state.material_traits.size())
        return static_cast<FractureKind>(state.material_traits.fracture[material]);
    return material_traits(state, material).fracture;
}

/// How far cracks run on.
float run_length(const RunRows& state, Row<Tasks> task, FractureKind kind) {
    switch (kind) {
        case FractureKind::Fine:
            break;
        case FractureKind::Coarse:
            return kCoarseRun * state.shells.mean_edge[state.shell_of(state.tasks.working[task])];
        case FractureKind::Large:
            return state.quick_runs.crack_length[task] * state.quick_runs.diagonal[task];
    }
    return 0;
}

}  // namespace

uint32_t crack_frequency_of(const RunRows& state, Row<Tasks> task) {
    const uint32_t given = state.quick_runs.crack_frequency[task];
    if (given > 0) return given;
    switch (kind_of(state, task)) {
        case FractureKind::Fine:
            return 64;
        case FractureKind::Coarse:
            return 16;
        case FractureKind::Large:
            break;
    }
    return 1;
}

namespace {

/// By steps that are granted and will not be run in this frame; what is left is owed, and taken from the next grant.
void pay_cuts(RunRows& state, Row<Tasks> task, uint32_t cut_edges) {
    const uint64_t cost = kUnitsQuickCut * cut_edges, a_step = quick_units_a_step(state, task);
    uint32_t& granted = state.tasks.steps_granted[task];
    const uint64_t steps = std::min<uint64_t>(granted, (cost + a_step - 1) / a_step);
    granted -= static_cast<uint32_t>(steps);
    state.tasks.units_owed[task] += cost - std::min(cost, steps * a_step);
}

}  // namespace

uint32_t grow_region(RunRows& state, Row<Tasks> task) {
    QuickRuns& runs = state.quick_runs;
    Tasks& tasks = state.tasks;
    if (tasks.lacks_room[task]) return 0;  // for more springs: nothing splits any more
    const RegionView region(state, task);
    const uint32_t frequency = crack_frequency_of(state, task);
    const Scratch<StrainedEdges> found(state.scratch);
    StrainedEdges& edges = *found;
    // Some of them will be gone, closed, or have no way to split.
    find_strained_edges(region, 4 * frequency, edges);
    if (edges.count == 0) return 0;
    const FractureKind kind = kind_of(state, task);
    Splitting s{region, kind, runs.bump_angle[task], run_length(state, task, kind), tasks.steps_done[task]};
    uint32_t splits = 0;
    for (uint32_t i = 0; i < edges.count && splits < frequency && !s.is_full; ++i) {
        splits += split_edge(s, edges.edge[i]);
        if (s.touched.is_enough()) flush(s);
    }
    flush(s);
    tasks.lacks_room[task] = s.is_full;
    tasks.crack_count[task] += s.cut_edges;
    tasks.start_count[task] += s.starts;
    pay_cuts(state, task, s.cut_edges);
    if (s.cut_edges > 0) build_patches(state, task);
    return s.cut_edges;
}

}  // namespace cullet
