#include "systems/models/thick_shell/hidden/grow_cracks.hpp"

#include "engine/random.hpp"
#include "systems/models/thick_shell/hidden/aim.hpp"
#include "systems/models/thick_shell/hidden/crack_candidates.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/hidden/join.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/models/thick_shell/shared/forget_cracks.hpp"
#include "systems/models/thick_shell/stiffness/refresh.hpp"
#include "systems/structures/shell/cut_ends.hpp"

namespace cullet {
namespace {

constexpr uint64_t kBranchSeed = 0x6272616e6368;
constexpr float kNeverReady = 1e30f;  // s

struct Batch {
    const RunRows& runs;
    Row<Tasks> task;
    ShellView shell;
    CrackLimits limits;
    HeadingFan fan;
    float time, check_interval;  // s, of the run and between two checks
    CrackSink& sink;
    uint32_t step;  // of the run
    Touched touched;
};

CrackState crack_at(const Batch& batch, uint32_t vertex) {
    return static_cast<CrackState>(batch.shell.state.vertices.crack[batch.shell.vertex(vertex)]);
}

Aim aim_at(Batch& batch, uint32_t vertex, Vec3 normal, Vec3 direction) {
    const Aim found = aim(batch.shell, vertex, normal, direction, batch.touched);
    batch.sink.refused += found.was_full;
    batch.sink.inserted += found.was_inserted;
    return found;
}

// When the crack came to this tip. A tip that went on at the first check that found it ready did so on time: counted
// from the check instead, a crack whose step takes two and a half checks would run a fifth too slow.
float arrival_time(const Batch& batch, float ready_time) {
    return batch.time - ready_time < batch.check_interval ? ready_time : batch.time;
}

void ban_near(Batch& batch, Vec3 place) {
    switch (batch.limits.fracture) {
        case FractureKind::Large:
            return ban_starts(batch.shell, place);
        case FractureKind::Coarse:
            return ban_starts(batch.shell, place, batch.time + batch.limits.ban_seconds);
        case FractureKind::Fine:
            return;
    }
}

// Interior ends become tips of the crack that started at `root`, headed as their arms; starts are banned round the
// cuts.
void finish_cut(Batch& batch, Vec3 place, float arrival, const Ends& ends, const Vec3* heading, uint32_t root) {
    const ShellView shell = batch.shell;
    Vertices& vertices = shell.state.vertices;
    ban_near(batch, place);
    for (uint32_t i = 0; i < ends.count; ++i) {
        const uint32_t row = shell.vertex(ends.end[i]);
        ban_near(batch, vertices.rest[row]);
        if (!ends.is_interior[i]) continue;
        Ring ring;
        walk_ring(shell, ends.end[i], ring);
        vertices.crack[row] = static_cast<uint8_t>(CrackState::Tip);
        vertices.heading.set(row, into_plane(heading[i], ring_normal(shell, ring)));
        vertices.ready_time[row] = arrival + length(vertices.rest[row] - place) / batch.limits.tip_speed;
        vertices.crack_start[row] = root;
    }
    batch.sink.cut_edges += ends.count;
}

bool try_cut(Batch& batch, uint32_t vertex, Ends& ends, const Vec3* heading, uint32_t root) {
    const Vertices& vertices = batch.shell.state.vertices;
    const uint32_t row = batch.shell.vertex(vertex);
    const Vec3 place = vertices.rest[row];
    const bool is_tip = crack_at(batch, vertex) == CrackState::Tip;
    const float arrival = is_tip ? arrival_time(batch, vertices.ready_time[row]) : batch.time;
    const CutOutcome outcome = cut_ends(batch.shell, vertex, ends, batch.touched);
    batch.sink.refused += outcome == CutOutcome::Full;
    if (outcome != CutOutcome::Cut) return false;
    finish_cut(batch, place, arrival, ends, heading, root);
    return true;
}

bool try_step(Batch& batch, uint32_t vertex, Vec3 normal, Vec3 direction, uint32_t root) {
    const Aim found = aim_at(batch, vertex, normal, direction);
    if (found.end == kNone) return false;
    Ends ends;
    ends.add(found.end);
    return try_cut(batch, vertex, ends, &direction, root);
}

// Two, four or six edges in equally spaced directions from an interior vertex, at least two of them different.
bool open_arms(Batch& batch, uint32_t vertex, const StartField& field) {
    const uint32_t arms = field.ratio > kSixArmRatio ? 6 : field.ratio > kFourArmRatio ? 4 : 2;
    const float cosine = arms == 6 ? 0.5f : arms == 4 ? 0.0f : -1.0f;
    const float sine = arms == 6 ? 0.8660254f : arms == 4 ? 1.0f : 0.0f;
    const Vec3 x = cross(field.normal, field.across);  // the crack's line
    Ends ends;
    Vec3 heading[kMostArms];
    float c = 1, s = 0;
    for (uint32_t arm = 0; arm < arms; ++arm) {
        const Vec3 direction = normalised(c * x - s * field.across);
        const Aim found = aim_at(batch, vertex, field.normal, direction);
        if (found.end != kNone && ends.add(found.end)) heading[ends.count - 1] = direction;
        const float turned = c * cosine - s * sine;
        s = c * sine + s * cosine;
        c = turned;
    }
    return try_cut(batch, vertex, ends, heading, vertex);
}

// Whether cracks of this kind of fracture may fork here: large ones run on alone, and in coarse fracture the
// neighbourhood of a fork, as that of any split vertex, starts no other.
bool may_fork(const Batch& batch, uint32_t vertex, uint32_t root) {
    const ShellView shell = batch.shell;
    const Vertices& vertices = shell.state.vertices;
    switch (batch.limits.fracture) {
        case FractureKind::Large:
            return false;
        case FractureKind::Coarse:
            if (root >= shell.vertex_count()) return true;  // of a piece, which forgot where its cracks started
            return length(vertices.rest[shell.vertex(vertex)] - vertices.rest[shell.vertex(root)]) >=
                   kForkSpacing * shell.shells().mean_edge[shell.row];
        case FractureKind::Fine:
            break;
    }
    return true;
}

// Whether a tip under this stress forks, with probability 1/2 by its place and time: a fork that was not taken may be
// taken later.
bool forks(const Batch& batch, uint32_t vertex, float stress) {
    if (!(batch.limits.branching > 0 && stress > batch.limits.branching * batch.limits.start)) return false;
    return Random{kBranchSeed}.uniform(vertex, batch.step) < 0.5;
}

// The branches' root is the fork, which spaces the next one from it.
bool try_fork(Batch& batch, uint32_t vertex, Vec3 normal, Vec3 direction) {
    const Vec3 side = cross(normal, direction);
    Ends ends;
    Vec3 heading[kMostArms];
    for (const float sine : {kBranchSine, -kBranchSine}) {
        const Vec3 branch = normalised(kBranchCosine * direction + sine * side);
        const Aim found = aim_at(batch, vertex, normal, branch);
        if (found.end != kNone && ends.add(found.end)) heading[ends.count - 1] = branch;
    }
    return ends.count == 2 && try_cut(batch, vertex, ends, heading, vertex);
}

bool stops_at_border(Batch& batch, uint32_t vertex) {
    if (!is_by_border(batch.runs, batch.task, vertex)) return false;
    batch.sink.is_at_border = true;
    return true;
}

void start_crack(Batch& batch, uint32_t vertex) {
    const ShellView shell = batch.shell;
    Vertices& vertices = shell.state.vertices;
    const uint32_t row = shell.vertex(vertex);
    if (!may_start(vertices, row, batch.limits.fracture, batch.time)) return;
    const StartField field = start_field(shell, vertex, batch.limits.grain);
    if (!(field.stress > batch.limits.start * vertices.strength_factor[row])) return;
    if (stops_at_border(batch, vertex)) return;
    Ring ring;
    walk_ring(shell, vertex, ring);
    const uint32_t refused = batch.sink.refused;
    vertices.crack_start[row] = vertex;
    const Vec3 along = cross(field.normal, field.across);
    const bool is_cut = ring.is_closed ? open_arms(batch, vertex, field)
                                       : try_step(batch, vertex, field.normal, along, vertex) ||
                                             try_step(batch, vertex, field.normal, -along, vertex);
    if (!is_cut) {
        // Where the mesh has no way for a crack none starts in this run; a lack of room may pass.
        if (batch.sink.refused != refused) return;
        vertices.is_start_banned[row] = 1;
        if (batch.limits.fracture != FractureKind::Large) vertices.ready_time[row] = kNeverReady;
        return;
    }
    ++batch.sink.starts;
    batch.sink.add({CrackEventKind::Start, vertex, vertices.rest[row], field.stress});
}

void advance_tip(Batch& batch, uint32_t vertex) {
    const ShellView shell = batch.shell;
    Vertices& vertices = shell.state.vertices;
    const uint32_t row = shell.vertex(vertex);
    if (crack_at(batch, vertex) != CrackState::Tip || batch.time < vertices.ready_time[row]) return;
    const ChosenHeading chosen = tip_heading(shell, vertex, batch.fan, batch.limits.grain);
    if (!(chosen.stress > batch.limits.tip)) return;
    if (stops_at_border(batch, vertex)) return;
    Ring ring;
    walk_ring(shell, vertex, ring);
    const Vec3 normal = ring_normal(shell, ring);
    const uint32_t root = vertices.crack_start[row];
    const float l = shell.shells().mean_edge[shell.row];
    const uint32_t meeting = find_crack_ahead(shell, vertex, chosen.direction, l);
    bool is_cut = false;
    if (meeting != kNone) {
        const Vec3 toward = into_plane(vertices.rest[shell.vertex(meeting)] - vertices.rest[row], normal);
        is_cut = try_step(batch, vertex, normal, toward, root);
    }
    if (!is_cut && may_fork(batch, vertex, root) && forks(batch, vertex, chosen.stress))
        is_cut = try_fork(batch, vertex, normal, chosen.direction);
    if (!is_cut) is_cut = try_step(batch, vertex, normal, chosen.direction, root);
    if (!is_cut) {
        // No way on now; it looks again after the time of one step.
        vertices.ready_time[row] = batch.time + l / batch.limits.tip_speed;
        return;
    }
    batch.sink.add({CrackEventKind::Advance, vertex, vertices.rest[row], chosen.stress});
}

}  // namespace

void begin_cracks(ShellView shell, bool is_fragment) {
    forget_cracks(shell, is_fragment);
    find_start_strengths(shell);
}

uint32_t grow_cracks(RunRows& state, Row<Tasks> task, CrackSink& sink) {
    Tasks& tasks = state.tasks;
    const ShellView shell(state, tasks.working[task]);
    const float time = static_cast<float>(tasks.steps_done[task]) * state.hidden_runs.time_step[task];
    const float check_interval = static_cast<float>(kStepsAStressCheck) * state.hidden_runs.time_step[task];
    Batch batch{state,
                task,
                shell,
                crack_limits(shell, tasks.strength_scale[task]),
                {},
                time,
                check_interval,
                sink,
                tasks.steps_done[task],
                Touched(kStiffnessRepair)};
    batch.touched.marks_elements = is_cut_out(state, task);
    const Scratch<Candidates> chosen(state.scratch);
    Candidates& candidates = *chosen;
    choose_candidates(shell, batch.limits, time, batch.fan, candidates);
    if (candidates.count == 0) return 0;
    const uint32_t cuts_before = sink.cut_edges, starts_before = sink.starts;
    bool is_whole = true;
    for (uint32_t i = 0; i < candidates.count; ++i) {
        const Candidate& c = candidates.candidate[i];
        if (c.is_tip)
            advance_tip(batch, c.vertex);
        else
            start_crack(batch, c.vertex);
        if (batch.touched.is_enough()) is_whole = refresh_stiffness(shell, batch.touched) && is_whole;
    }
    is_whole = refresh_stiffness(shell, batch.touched) && is_whole;
    sink.is_out_of_slots = sink.is_out_of_slots || !is_whole;

    const uint32_t cuts = sink.cut_edges - cuts_before;
    // Too low does no harm, so not after each cut: a pass over all elements costs a good part of a step.
    constexpr uint32_t kCutsAPass = 16;
    const uint32_t all_cuts = tasks.crack_count[task] + cuts;
    if (all_cuts / kCutsAPass != tasks.crack_count[task] / kCutsAPass) find_start_strengths(shell);
    tasks.crack_count[task] = all_cuts;
    tasks.start_count[task] += sink.starts - starts_before;
    tasks.units_owed[task] += units_of_crack(shell.vertex_count(), is_ahead(tasks, task)) * cuts + batch.touched.units;
    if (cuts) state.hidden_runs.last_event_time[task] = time;
    return cuts;
}

}  // namespace cullet
