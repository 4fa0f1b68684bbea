#include "systems/models/thick_shell/hidden/run_out.hpp"

#include <algorithm>

#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/hidden/aim.hpp"
#include "systems/models/thick_shell/hidden/crack_rules.hpp"
#include "systems/models/thick_shell/hidden/heading.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/models/thick_shell/stiffness/refresh.hpp"
#include "systems/structures/shell/cut_ends.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

/// Cosines of the turns to where a crack ends, the straighter one first: 15 and 35 degrees. What neither finds stays.
/// Two more steps, to 55 degrees, bend cracks visibly where they had stopped.
constexpr float kTurns[] = {0.966f, 0.819f};
constexpr float kSteps = 3;  // a mean edge of way takes one step, inserted vertices make it up to two

CrackState crack_at(const ShellView& shell, uint32_t vertex) {
    return static_cast<CrackState>(shell.state.vertices.crack[shell.vertex(vertex)]);
}

/// Where the crack of this tip started: a fork is the root of its branches, and has the root of the crack that forked.
/// kNone: that is not of this shell any more. A file's roots may go round in a ring, hence the bound.
uint32_t origin_of(const ShellView& shell, uint32_t tip) {
    const Vertices& vertices = shell.state.vertices;
    const uint32_t count = shell.vertex_count();
    uint32_t origin = vertices.crack_start[shell.vertex(tip)];
    for (uint32_t forks = 0; origin < count && forks < count; ++forks) {
        const uint32_t before = vertices.crack_start[shell.vertex(origin)];
        if (before == origin || before >= count) break;
        origin = before;
    }
    return origin < count ? origin : kNone;
}

bool may_end_at(const ShellView& shell, uint32_t vertex) {
    if (crack_at(shell, vertex) == CrackState::Cracked) return true;
    Ring ring;
    walk_ring(shell, vertex, ring);
    return ring.count > 0 && !ring.is_closed;
}

/// Where the crack of this tip would end, or kNone: the nearest such vertex, one a little aside counts as farther. Its
/// own crack counts too: another branch of it, or itself where it has come round; what lies behind the tip is not
/// ahead.
uint32_t end_of(const ShellView& shell, const RunRows& runs, Row<Tasks> task, uint32_t tip, float reach, float turn) {
    const Vertices& vertices = shell.state.vertices;
    const uint32_t row = shell.vertex(tip);
    const Vec3 place = vertices.rest[row], heading = vertices.heading[row];
    uint32_t found = kNone;
    float nearest = reach;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t other = shell.vertex(v);
        if (v == tip || vertices.element[other] == kNone) continue;
        const Vec3 way = vertices.rest[other] - place;
        const float ahead = dot(way, heading), distance = length(way);
        if (!(ahead > turn * distance) || !(distance > 0) || distance * distance / ahead >= nearest) continue;
        if (!(dot(vertices.inward[row], vertices.inward[other]) > kJoinCosine)) continue;
        if (!may_end_at(shell, v) || is_by_border(runs, task, v)) continue;
        nearest = distance * distance / ahead;
        found = v;
    }
    return found;
}

uint32_t run_to(const ShellView& shell, const RunRows& runs, Row<Tasks> task, uint32_t tip, uint32_t target,
                Touched& touched, bool& is_whole) {
    Vertices& vertices = shell.state.vertices;
    const uint32_t root = vertices.crack_start[shell.vertex(tip)];
    const Vec3 goal = vertices.rest[shell.vertex(target)];
    const float l = shell.shells().mean_edge[shell.row];
    const float way = length(goal - vertices.rest[shell.vertex(tip)]);
    uint32_t cuts = 0;
    for (float step = 0; step < kSteps * (1 + way / l) && !is_by_border(runs, task, tip); ++step) {
        const uint32_t row = shell.vertex(tip);
        Ring ring;
        walk_ring(shell, tip, ring);
        const Vec3 normal = ring_normal(shell, ring);
        const Vec3 direction = into_plane(goal - vertices.rest[row], normal);
        if (!(dot(direction, direction) > 0)) break;
        const Aim found = aim(shell, tip, normal, direction, touched);
        Ends ends;
        if (found.end == kNone || !ends.add(found.end)) break;
        if (cut_ends(shell, tip, ends, touched) != CutOutcome::Cut) break;
        ++cuts;
        if (touched.is_enough()) is_whole = refresh_stiffness(shell, touched) && is_whole;
        if (!ends.is_interior[0]) break;  // it has met a border or a crack
        tip = ends.end[0];
        const uint32_t next = shell.vertex(tip);
        vertices.crack[next] = static_cast<uint8_t>(CrackState::Tip);
        vertices.heading.set(next, direction);
        vertices.crack_start[next] = root;
    }
    return cuts;
}

}  // namespace

bool run_out_cracks(RunRows& state, Row<Tasks> task) {
    const ShellView shell(state, state.tasks.working[task]);
    const Vertices& vertices = state.vertices;
    const float run_out = material_traits(state, shell.structures().material[shell.structure]).run_out;
    if (!(run_out > 0)) return false;
    Touched touched(kStiffnessRepair);
    touched.marks_elements = is_cut_out(state, task);
    bool is_whole = true;
    uint32_t cuts = 0;
    const uint32_t count = shell.vertex_count(), elements = shell.element_count();
    for (uint32_t v = 0; v < count; ++v) {
        if (crack_at(shell, v) != CrackState::Tip) continue;
        const uint32_t origin = origin_of(shell, v);
        if (origin == kNone) continue;
        const float crack = length(vertices.rest[shell.vertex(v)] - vertices.rest[shell.vertex(origin)]);
        const float reach = run_out * std::max(crack, kStartSpacing * shell.shells().mean_edge[shell.row]);
        uint32_t target = kNone;
        for (const float turn : kTurns)
            if (target == kNone) target = end_of(shell, state, task, v, reach, turn);
        if (target != kNone) cuts += run_to(shell, state, task, v, target, touched, is_whole);
    }
    is_whole = refresh_stiffness(shell, touched) && is_whole;
    // Nothing steps this shell again before its next task, which assembles what is not assembled.
    Shells& shells = shell.shells();
    if (!is_whole) shells.packs[shell.row].count = shells.blocks[shell.row].count = shells.links[shell.row].count = 0;
    state.tasks.crack_count[task] += cuts;
    state.tasks.units_owed[task] +=
        units_of_crack(shell.vertex_count(), is_ahead(state.tasks, task)) * cuts + touched.units;
    return cuts > 0 || shell.element_count() != elements;
}

}  // namespace cullet
