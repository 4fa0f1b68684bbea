#include "systems/models/thick_shell/hidden/hidden_region.hpp"

#include <algorithm>

#include "systems/models/thick_shell/hidden/crack_candidates.hpp"
#include "systems/models/thick_shell/shared/cut_rows.hpp"
#include "systems/models/thick_shell/shared/working_room.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/models/thick_shell/stiffness/costs.hpp"
#include "systems/structures/shell/costs.hpp"
#include "systems/structures/shell/vertex_sums.hpp"

namespace cullet {
namespace {

/// Edges from the border of the cut-out: vertices nearer than the first are held, so that walls cannot turn at the
/// border; nearer than the second nothing is cut.
constexpr uint32_t kHeldRings = 2, kUncutRings = kHeldRings + kCutOutBorderRings;
/// Of the stress that starts a crack: near the border it makes the region grow. Before the first crack waves that go on
/// may still break something far away, at a free edge or where the wall is weak. Vases of 14,000 vertices stay whole on
/// a region, up to 12 m/s, where the whole body cracks from 2.6 m/s on. What has cracked where it was hit lets little
/// through.
constexpr float kGrowsAt = 0.1f, kGrowsOnceCrackedAt = 0.5f;

template <class Table>
void grow(Table& table, uint32_t rows) {
    if (rows > table.size()) table.append(rows - table.size());
}

/// Calls f(vertex) for each held vertex of the cut-out, rising.
template <class F>
void for_each_held(Tables<const HiddenRuns, const MarkedPacks> state, Row<Tasks> task, F&& f) {
    const MarkedPacks& packs = state.marked_packs;
    const uint32_t first = task * kMostMarkedPacks, end = first + state.hidden_runs.pack_count[task];
    for (uint32_t row = first; row < end; ++row)
        for (uint32_t k = 0; packs.held[row] >> k; ++k)
            if (packs.held[row] >> k & 1) f(packs.pack[row] * kLanes + k);
}

/// Writes how many edges each vertex is from the cut-out's border into Vertices.copy, up to kUncutRings.
void measure_from_border(const CutRows& rows, const ShellView& cut) {
    const ShellRows& state = cut.state;
    const Elements& elements = state.elements;
    uint32_t* const far = cut.state.vertices.copy.data() + cut.vertex(0);
    std::fill_n(far, cut.vertex_count(), kUncutRings);
    for (uint32_t e = 0; e < rows.element_count; ++e)
        for (uint32_t k = 0; k < 3; ++k) {
            if (elements.neighbour[cut.element(e)][k] != kNone) continue;
            if (elements.neighbour[rows.source.element(rows.list[e])][k] == kNone) continue;  // the body's own border
            const auto& corner = elements.corner[cut.element(e)];
            far[corner[k]] = far[corner[(k + 1) % 3]] = 0;
        }
    for (uint32_t ring = 0; ring + 1 < kUncutRings; ++ring)
        for (uint32_t e = 0; e < rows.element_count; ++e) {
            const auto& corner = elements.corner[cut.element(e)];
            if (far[corner[0]] != ring && far[corner[1]] != ring && far[corner[2]] != ring) continue;
            for (const uint32_t v : corner) far[v] = std::min(far[v], ring + 1);
        }
}

/// Packs with vertices by the border; MarkedPacks calls the held ones held, and what moves but is not cut awake.
void list_border(RunRows& state, Row<Tasks> task) {
    const ShellView cut(state, state.tasks.working[task]);
    MarkedPacks& packs = state.marked_packs;
    const uint32_t first = task * kMostMarkedPacks;
    uint32_t count = 0;
    for (uint32_t v = 0; v < cut.vertex_count(); v += kLanes) {
        uint32_t held = 0, near = 0;
        for (uint32_t k = 0; k < std::min(kLanes, cut.vertex_count() - v); ++k) {
            const uint32_t row = cut.vertex(v + k), far = state.vertices.copy[row];
            held |= uint32_t{far < kHeldRings} << k;
            near |= uint32_t{far >= kHeldRings && far < kUncutRings} << k;
            if (far < kUncutRings) state.vertices.strength_factor[row] *= kGrowsAt;
        }
        if (!(held | near)) continue;
        packs.pack[first + count] = v / kLanes;
        packs.held[first + count] = static_cast<uint8_t>(held);
        packs.awake[first + count] = static_cast<uint8_t>(near);
        ++count;
    }
    state.hidden_runs.pack_count[task] = count;
}

/// All that the cut-out does not have, and what is held in it: the body less what moves, which is at most half of it.
void weigh_rest(RunRows& state, Row<Tasks> task, const ShellView& source, const ShellView& cut) {
    const Vertices& vertices = state.vertices;
    const VertexSums body = vertex_sums(source);
    VertexSums rest = body;
    for (uint32_t row = cut.vertex(0); row < cut.vertex(cut.vertex_count()); ++row) {
        if (vertices.element[row] == kNone || vertices.copy[row] < kHeldRings) continue;
        const double m = vertices.mass[row];
        const Vec3d x(vertices.rest[row]);
        rest.mass -= m;
        rest.first -= m * x;
        rest.second = rest.second - m * outer(x);
        rest.pinned -= vertices.is_pinned[row];
    }
    RegionRests& rests = state.region_rests;
    const Vec3d centre = rest.centre();
    rests.inverse_mass[task] = rest.pinned > 0 || !(rest.mass > 0) ? 0 : 1 / rest.mass;
    rests.centre.set(task, centre);
    rests.inertia[task] = inertia_of(rest.second - rest.mass * outer(centre));
    rests.body_centre.set(task, body.centre());
}

/// For both kinds of vertices by the border.
template <class F>
void for_each_by_border(const RunRows& state, Row<Tasks> task, F&& f) {
    const MarkedPacks& packs = state.marked_packs;
    const uint32_t first = task * kMostMarkedPacks, end = first + state.hidden_runs.pack_count[task];
    for (uint32_t row = first; row < end; ++row)
        for (uint32_t k = 0; (packs.held[row] | packs.awake[row]) >> k; ++k)
            if ((packs.held[row] | packs.awake[row]) >> k & 1) f(packs.pack[row] * kLanes + k);
}

/// Puts a held vertex where the rest has it.
void follow(Tables<const RegionRests, Vertices> state, Row<Tasks> task, uint32_t row, const BodyMotion& now) {
    const RegionRests& rests = state.region_rests;
    Vertices& vertices = state.vertices;
    const Vec3 v = now.at(vertices.rest[row]).to_float();
    const Vec3d arm = Vec3d(vertices.rest[row]) - rests.centre[task];
    vertices.velocity.set(row, v);
    vertices.displacement.set(row, (rests.travel[task] + cross(rests.turn[task], arm)).to_float());
}

}  // namespace

BodyMotion rest_motion(Tables<const RegionRests> state, Row<Tasks> task) {
    const RegionRests& rests = state.region_rests;
    return {rests.centre[task], rests.velocity[task], rests.spin[task]};
}

bool reserve_hidden_region(RunRows& state, Row<Tasks> task, uint32_t vertices, const char** full) {
    if (vertices > kMostMarkedPacks * kLanes / 2) return false;
    grow(state.region_rests, task + 1);
    grow(state.marked_packs, (task + 1) * kMostMarkedPacks);
    if (reserve_cut_out(state, task, {kNone, vertices}, full) != CutOutResult::Reserved) return false;
    if (state.shells.vertices[state.shell_of(state.tasks.working[task])].count > kMostMarkedPacks * kLanes) {
        release_shell(state, state.tasks.working[task]);
        state.tasks.working[task] = {};
        state.hidden_runs.cut_elements[task] = 0;
        return false;
    }
    state.marked_packs.clear_rows(task * kMostMarkedPacks, kMostMarkedPacks);
    state.region_rests.clear_rows(task, 1);
    state.region_rests.most_vertices[task] = vertices;
    return true;
}

bool give_hidden_rows(RunRows& state, Row<Tasks> task, uint32_t vertices, const char** full) {
    Tasks& tasks = state.tasks;
    const ShellView source(state, tasks.source[task]);
    uint32_t count = 0;
    if (vertices != kNone && reserve_hidden_region(state, task, vertices, full)) {
        count = state.shells.vertices[state.shell_of(tasks.working[task])].count;
    } else {
        if (task < state.region_rests.size()) state.region_rests.clear_rows(task, 1);
        tasks.working[task] = make_shell_unclear(state, working_room(source), full);
        if (!tasks.working[task].exists()) return false;
        count = source.vertex_count();
    }
    const bool is_assembled = packs_to_assemble(state, task) == 0;
    tasks.units_owed[task] += uint64_t{count} * (kUnitsOpen + (is_assembled ? 0 : kUnitsAssemble));
    return true;
}

uint32_t packs_to_assemble(RunKinds state, Row<Tasks> task) {
    const Shells& shells = state.shells;
    const Row<Shells> source = shell_of(state.structures, state.tasks.source[task]);
    const bool is_region = is_hidden_region(state, task);
    if (!is_region && shells.packs[source].count > 0) return 0;
    const Row<Shells> copied = is_region ? shell_of(state.structures, state.tasks.working[task]) : source;
    return (shells.vertices[copied].count + kLanes - 1) / kLanes;
}

void find_rest(RunRows& state, Row<Tasks> task) {
    const ShellView source(state, state.tasks.source[task]), cut(state, state.tasks.working[task]);
    CutRows rows(source);
    rows.element_count = state.hidden_runs.cut_elements[task];
    measure_from_border(rows, cut);
    list_border(state, task);
    weigh_rest(state, task, source, cut);
}

void start_rest(RunRows& state, Row<Tasks> task) {
    RegionRests& rests = state.region_rests;
    const Vec3d velocity(state.tasks.start_velocity[task]), spin(state.tasks.start_spin[task]);
    const bool is_free = rests.inverse_mass[task] > 0;
    rests.velocity.set(task, is_free ? velocity + cross(spin, rests.centre[task] - rests.body_centre[task]) : Vec3d{});
    rests.spin.set(task, is_free ? spin : Vec3d{});
    rests.travel.set(task, {});
    rests.turn.set(task, {});
    rests.wants_more[task] = 0;
    const ShellView cut(state, state.tasks.working[task]);
    const BodyMotion now = rest_motion(state, task);
    const float beta = state.hidden_runs.damping_time[task];
    for_each_held(state, task, [&](uint32_t v) {
        const uint32_t row = cut.vertex(v);
        follow(state, task, row, now);
        const Vec3 w = beta * state.vertices.velocity[row];
        for (int side = 0; side < 2; ++side) state.vertices.probe.set(row, {w.x, w.y, w.z, 0}, side);
    });
}

void move_rest(PassedTables state, Row<Tasks> task, uint32_t side) {
    RegionRests& rests = state.region_rests;
    Vertices& vertices = state.vertices;
    const ShellIn<PassedTables> cut(state, state.tasks.working[task]);
    const double dt = state.hidden_runs.time_step[task];
    if (rests.inverse_mass[task] > 0) {
        const BodyMotion before = rest_motion(state, task);
        Vec3d push, moment;
        for_each_held(state, task, [&](uint32_t v) {
            const uint32_t row = cut.vertex(v);
            const Vec3d gained =
                vertices.mass[row] * (Vec3d(vertices.velocity[row]) - Vec3d(before.at(vertices.rest[row]).to_float()));
            push += gained;
            moment += cross(Vec3d(vertices.rest[row]) - before.centre, gained);
        });
        rests.velocity.set(task, before.velocity + rests.inverse_mass[task] * push);
        rests.spin.set(task, before.spin + inverse(rests.inertia[task]) * moment);
        rests.travel.set(task, rests.travel[task] + dt * rests.velocity[task]);
        rests.turn.set(task, rests.turn[task] + dt * rests.spin[task]);
    }
    const BodyMotion now = rest_motion(state, task);
    const float beta = state.hidden_runs.damping_time[task];
    Float4* const next = vertices.probe.data(static_cast<int>(~side & 1));
    for_each_held(state, task, [&](uint32_t v) {
        const uint32_t row = cut.vertex(v);
        follow(state, task, row, now);
        const Vec3 w = vertices.displacement[row] + beta * vertices.velocity[row];
        next[row] = {w.x, w.y, w.z, 0};
    });
}

void bear_more(RunRows& state, Row<Tasks> task) {
    const ShellView cut(state, state.tasks.working[task]);
    for_each_by_border(state, task, [&](uint32_t v) {
        state.vertices.strength_factor[cut.vertex(v)] *= kGrowsOnceCrackedAt / kGrowsAt;
    });
    find_start_strengths(cut);
}

double rest_energy(const RunRows& state, Row<Tasks> task) {
    const RegionRests& rests = state.region_rests;
    if (!(rests.inverse_mass[task] > 0)) return 0;
    const Vec3d v = rests.velocity[task], w = rests.spin[task];
    double energy = dot(v, v) / rests.inverse_mass[task] + dot(w, rests.inertia[task] * w);
    const uint32_t first = state.shells.vertices[state.shell_of(state.tasks.working[task])].first;
    for_each_held(state, task, [&](uint32_t u) {
        const Vec3d own(state.vertices.velocity[first + u]);
        energy -= state.vertices.mass[first + u] * dot(own, own);
    });
    return 0.5 * energy;
}

bool is_by_border(const RunRows& state, Row<Tasks> task, uint32_t vertex) {
    if (!is_hidden_region(state, task)) return false;
    const MarkedPacks& packs = state.marked_packs;
    const uint32_t* const begin = packs.pack.data() + size_t{task} * kMostMarkedPacks;
    const uint32_t* const end = begin + state.hidden_runs.pack_count[task];
    const uint32_t* const at = std::lower_bound(begin, end, vertex / kLanes);
    if (at == end || *at != vertex / kLanes) return false;
    const auto row = static_cast<uint32_t>(at - packs.pack.data());
    return (packs.held[row] | packs.awake[row]) >> (vertex % kLanes) & 1;
}

std::string trouble_of_hidden_region(RunRows& state, uint32_t task) {
    const std::string where = "region_rests[" + std::to_string(task) + "]";
    const RegionRests& rests = state.region_rests;
    if (task >= rests.size() || rests.most_vertices[task] == 0) return where + ": a cut-out has none";
    if (rests.wants_more[task] > 1 || !(rests.inverse_mass[task] >= 0)) return where + ": a number is out of range";
    const uint32_t first = task * kMostMarkedPacks, count = state.hidden_runs.pack_count[task];
    if (count > kMostMarkedPacks || first + count > state.marked_packs.size())
        return where + ": its border has " + std::to_string(count) + " packs";
    const uint32_t vertices = state.shells.vertices[state.shell_of(state.tasks.working[task])].count;
    for (uint32_t row = first; row < first + count; ++row) {
        const uint32_t pack = state.marked_packs.pack[row];
        if (pack >= vertices / kLanes || (row > first && pack <= state.marked_packs.pack[row - 1]))
            return where + ": the packs of its border do not rise or are none of its shell";
    }
    return trouble_of_cut_out(state, task);
}

}  // namespace cullet
