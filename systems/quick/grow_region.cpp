#include "systems/quick/grow_region.hpp"

#include "engine/random.hpp"
#include "systems/cook/materials.hpp"
#include "systems/costs.hpp"
#include "systems/damage/contact.hpp"
#include "systems/damage/heading.hpp"
#include "systems/quick/plane_split.hpp"
#include "systems/quick/put_vertex.hpp"
#include "systems/quick/strained_edges.hpp"
#include "systems/springs/rebuild_springs.hpp"

namespace cullet {
namespace {

constexpr uint64_t kEndSeed = 0x71756965636b31, kBumpSeed = 0x62756d70;
/// Cosine of the largest turn from a crack's way to the edge that it takes next (C4: a forward component of 0.3).
constexpr float kForward = 0.3f;
constexpr float kFarEnough = 1e-4f;  // of a length: sums of floats

struct Splitting {
    RegionView region;
    FractureKind kind;
    float bump_angle;  // rad
    float run_length;  // m, of a large fracture's crack on either side
    uint32_t step;     // of the run
    Touched touched;
    uint32_t cut_edges = 0, starts = 0;
    bool is_full = false;       // no room for more
    bool are_springs_old = false;  // there was none for the springs of what was cut: those there are hold on

    State& state() const { return region.state; }
    const ShellView& shell() const { return region.shell; }
    uint32_t row(uint32_t v) const { return region.shell.vertex(v); }
    Vec3 rest(uint32_t v) const { return region.state.vertices.rest[row(v)]; }
    bool is_tip(uint32_t v) const {
        return region.state.vertices.crack[row(v)] == static_cast<uint8_t>(CrackState::Tip);
    }
};

/// Springs, masses and bounds of what changed in the region; the rest has none.
void flush(Splitting& s) {
    uint32_t list[VertexList::kMost], count = 0;
    for (const uint32_t v : s.touched.weighed.span())
        if (s.region.is_awake(v) || s.region.is_held(v)) list[count++] = v;
    s.is_full = s.is_full || s.touched.weighed.has_overflowed;
    s.touched.clear();
    if (count == 0) return;
    std::sort(list, list + count);
    if (s.are_springs_old) return;
    s.are_springs_old = !rebuild_springs(s.region.springs, {list, count});
    s.is_full = s.is_full || s.are_springs_old;
    if (!s.are_springs_old) limit_springs(s.region, {list, count});
}

/// The copies that a cut at `vertex` made are in the region as what they are copies of.
void add_copies(const Splitting& s, uint32_t vertex, const Ends& ends, uint32_t first_copy) {
    for (uint32_t c = first_copy; c < s.shell().vertex_count(); ++c) {
        uint32_t origin = vertex;
        for (uint32_t i = 0; i < ends.count; ++i)
            if (s.rest(ends.end[i]) == s.rest(c)) origin = ends.end[i];
        const bool is_awake = s.region.is_awake(origin);
        if (!is_awake && !s.region.is_held(origin)) continue;
        s.region.add(c, !is_awake);
        const SpringView& view = s.region.springs;
        if (view.has_layers())
            s.state().twins.copy_rows(s.state().twins, view.twin(origin), view.twin(c), 1);
    }
}

struct Split {
    bool is_cut = false;
    Ends ends;
};

// Rules 1 to 6 of C3 after the re-meshing of C5. A fan of one element, and a plane that has all of the ring on one
// side, split nothing.
Split split_along(Splitting& s, uint32_t vertex, Vec3 normal) {
    const ShellView& shell = s.shell();
    Split split;
    for (;;) {
        const PlaneCrossing crossing = find_plane_crossing(shell, vertex, normal);
        s.is_full = s.is_full || crossing.is_full;
        if (crossing.element == kNone) break;
        put_vertex(s.region, crossing.element, crossing.edge, crossing.tau, s.touched);
    }
    Ring ring;
    walk_ring(shell, vertex, ring);
    if (ring.count < 2) return split;
    const RingSides sides = choose_sides(shell, vertex, ring, normal);
    if (!sides.is_split) return split;
    split.ends = ends_between(shell, ring, sides);
    const uint32_t first_copy = shell.vertex_count();
    const CutOutcome outcome = cut_ends(shell, vertex, split.ends, s.touched);
    s.is_full = s.is_full || outcome == CutOutcome::Full;
    if (outcome != CutOutcome::Cut) return split;
    add_copies(s, vertex, split.ends, first_copy);
    s.cut_edges += split.ends.count;
    split.is_cut = true;
    return split;
}

/// Ends that were interior are tips now.
void mark_tips(const Splitting& s, uint32_t vertex, const Ends& ends, uint32_t root) {
    Vertices& vertices = s.state().vertices;
    Ring ring;
    for (uint32_t i = 0; i < ends.count; ++i) {
        if (!ends.is_interior[i]) continue;
        const uint32_t row = s.row(ends.end[i]);
        walk_ring(s.shell(), ends.end[i], ring);
        vertices.crack[row] = static_cast<uint8_t>(CrackState::Tip);
        vertices.crack_start[row] = root;
        vertices.heading.set(row, into_plane(s.rest(ends.end[i]) - s.rest(vertex), ring_normal(s.shell(), ring)));
    }
}

/// Turned about the unit vector `axis`.
Vec3 turn(Vec3 v, Vec3 axis, double angle) {
    double sine = 0, cosine = 1;
    sine_cosine(angle, sine, cosine);
    const auto s = static_cast<float>(sine), c = static_cast<float>(cosine);
    return c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
}

// C4: no criterion is asked. The plane goes on through each new tip, turned a little about the shell's normal there: its
// own turns do not add up, or cracks would curl.
void run_on(Splitting& s, uint32_t tip, Vec3 way, Vec3 normal, uint32_t root) {
    Vertices& vertices = s.state().vertices;
    float left = s.run_length;
    while (left > 0 && !s.is_full) {
        Ring ring;
        walk_ring(s.shell(), tip, ring);
        if (ring.count < 2 || ring.is_closed) return;
        const double bump = s.bump_angle * (2 * Random{kBumpSeed}.uniform(tip, s.step) - 1);
        const Vec3 plane = turn(normal, ring_normal(s.shell(), ring), bump);
        const Split split = split_along(s, tip, plane);
        if (!split.is_cut) return;
        vertices.crack_start[s.row(tip)] = root;
        mark_tips(s, tip, split.ends, root);
        const uint32_t end = split.ends.end[0];
        const Vec3 along = s.rest(end) - s.rest(tip);
        const float l = length(along);
        if (s.touched.is_enough()) flush(s);
        if (!split.ends.is_interior[0] || dot(along, way) < kForward * l) return;
        left -= std::max(l, kFarEnough * s.run_length);
        way = (1 / l) * along;
        tip = end;
    }
}

/// C4, coarse: springs at the vertex, its copy and its neighbours crack no more, but those of the crack's ends do.
void close_neighbours(const Splitting& s, uint32_t vertex, const Ends& ends, uint32_t first_copy) {
    Vertices& vertices = s.state().vertices;
    const auto is_end = [&](uint32_t v) {
        for (uint32_t i = 0; i < ends.count; ++i)
            if (ends.end[i] == v) return true;
        return false;
    };
    const auto close = [&](uint32_t v) {
        Ring ring;
        walk_ring(s.shell(), v, ring);
        for (uint32_t i = 0; i < ring.count; ++i)
            for (const uint32_t n : s.state().elements.corner[s.shell().element(ring.element[i])])
                if (!is_end(n)) vertices.is_start_banned[s.row(n)] = 1;
    };
    close(vertex);
    for (uint32_t c = first_copy; c < s.shell().vertex_count(); ++c)
        if (s.rest(c) == s.rest(vertex)) close(c);
}

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
    const Split split = split_along(s, vertex, normal);
    if (!split.is_cut) return false;
    const uint32_t old_root = vertices.crack_start[s.row(vertex)];
    const uint32_t root = was_cracked && old_root != kNone ? old_root : vertex;
    vertices.crack_start[s.row(vertex)] = root;
    s.starts += !was_cracked;
    mark_tips(s, vertex, split.ends, root);
    // Large as well: its cracks are to be few and long, and without it the patch crumbles into slivers.
    if (s.kind != FractureKind::Fine) close_neighbours(s, vertex, split.ends, first_copy);
    if (s.kind == FractureKind::Large)
        for (uint32_t i = 0; i < split.ends.count && !s.is_full; ++i) {
            if (!split.ends.is_interior[i]) continue;
            const Vec3 way = normalised(s.rest(split.ends.end[i]) - s.rest(vertex));
            run_on(s, split.ends.end[i], way, normal, root);
        }
    return true;
}

}  // namespace

uint32_t crack_frequency_of(const State& state, Row<Tasks> task) {
    const uint32_t given = state.quick_runs.crack_frequency[task];
    if (given > 0) return given;
    switch (material_traits(state, state.shells.material[state.tasks.shell[task]]).fracture) {
        case FractureKind::Fine: return 64;
        case FractureKind::Coarse: return 16;
        case FractureKind::Large: break;
    }
    return 1;
}

uint32_t grow_region(State& state, Row<Tasks> task) {
    QuickRuns& runs = state.quick_runs;
    Tasks& tasks = state.tasks;
    if (runs.is_full[task]) return 0;
    const RegionView region(state, task);
    const uint32_t frequency = crack_frequency_of(state, task);
    StrainedEdges edges;
    // Some of them will be gone, closed, or have no way to split.
    find_strained_edges(region, 4 * frequency, edges);
    if (edges.count == 0) return 0;
    const float length = runs.crack_length[task] * runs.diagonal[task];
    Splitting s{region,
                material_traits(state, state.shells.material[region.shell.row]).fracture,
                runs.bump_angle[task],
                length,
                tasks.steps_done[task],
                {},
                0,
                0,
                false,
                false};
    uint32_t splits = 0;
    for (uint32_t i = 0; i < edges.count && splits < frequency && !s.is_full; ++i) {
        splits += split_edge(s, edges.edge[i]);
        if (s.touched.is_enough()) flush(s);
    }
    flush(s);
    runs.is_full[task] = s.is_full;
    tasks.crack_count[task] += s.cut_edges;
    tasks.start_count[task] += s.starts;
    tasks.units_owed[task] += kUnitsQuickCut * s.cut_edges;
    if (s.cut_edges > 0) build_patches(state, task);
    return s.cut_edges;
}

}  // namespace cullet
