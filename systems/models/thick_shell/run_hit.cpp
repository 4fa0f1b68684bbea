#include "systems/models/thick_shell/run_hit.hpp"

#include <algorithm>
#include <limits>

#include "engine/random.hpp"
#include "systems/models/thick_shell/hidden/brittle_loop.hpp"
#include "systems/models/thick_shell/hidden/crack_candidates.hpp"
#include "systems/models/thick_shell/hidden/energy.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/hidden/restart.hpp"
#include "systems/models/thick_shell/hidden/run_out.hpp"
#include "systems/models/thick_shell/quick/quick_loop.hpp"
#include "systems/models/thick_shell/quick/region_motion.hpp"
#include "systems/models/thick_shell/shared/working_room.hpp"
#include "systems/structures/shell/group_fragments.hpp"
#include "systems/structures/shell/patch_radius.hpp"
#include "systems/structures/shell/struck_normal.hpp"

namespace cullet {
namespace {

constexpr Row<Tasks> kTask{0};

/// Rows that start_task fills; of the whole shell where a region would be too wide.
bool give_rows(RunRows& state, uint32_t region_vertices, bool is_quick) {
    const char* full = nullptr;
    if (region_vertices > 0 && reserve_hidden_region(state, kTask, region_vertices, &full)) return true;
    const ShellView source(state, state.tasks.source[kTask]);
    state.tasks.working[kTask] = make_shell_unclear(state, is_quick ? quick_room(source) : working_room(source), &full);
    return state.tasks.working[kTask].exists();
}

}  // namespace

bool open_hit(RunRows& state, Row<Structures> source, const HitDescription& hit) {
    const ShellView before(state, source);
    Tasks& tasks = state.tasks;
    tasks.clear_rows(kTask, 1);
    state.hidden_runs.clear_rows(kTask, 1);
    tasks.state[kTask] = static_cast<uint8_t>(TaskState::Running);
    tasks.body[kTask] = {};
    tasks.source[kTask] = source;
    tasks.working[kTask] = {};
    tasks.start_velocity.set(kTask, hit.velocity);
    tasks.start_spin.set(kTask, hit.spin);
    tasks.strength_scale[kTask] = hit.strength_scale;
    set_task_times(state, kTask);
    state.hidden_runs.time_step[kTask] *= hit.step_scale;
    set_hidden_task(state.quick_runs, kTask);
    if (hit.quick) set_quick_task(state, kTask, *hit.quick, hit.layers);
    tasks.contact_count[kTask] = 1;
    TaskContacts& contacts = state.task_contacts;
    contacts.clear_rows(0, 1);
    contacts.point.set(0, hit.point);
    contacts.striker[0] = {};
    contacts.striker_inverse_mass[0] = hit.striker_inverse_mass;
    contacts.striker_radius[0] = hit.striker_radius;
    contacts.start_speed[0] = hit.striker_speed;
    contacts.radius[0] = patch_radius(state.shells, state.shell_of(source), hit.striker_radius);
    const bool is_ball = hit.striker_radius > 0;
    contacts.normal.set(
        0, is_ball ? struck_normal(ShellView(state, source), hit.point, hit.normal, contacts.radius[0]) : hit.normal);
    const Vec3 arm = hit.point - state.structures.centre[source].to_float();
    tasks.approach_speed[kTask] = hit.striker_speed - dot(hit.velocity + cross(hit.spin, arm), hit.normal);
    if (!give_rows(state, hit.region_vertices, hit.quick)) {
        tasks.state[kTask] = static_cast<uint8_t>(TaskState::Free);
        return false;
    }
    ++state.structures.users[source];
    start_task(state, Blows(1), kTask);
    const char* full = "";
    if (hit.quick) return wake_region_alone(state, Blows(1), kTask, &full);
    return true;
}

bool widen_hit(RunRows& state) {
    if (!is_hidden_region(state, kTask) || !state.region_rests.wants_more[kTask]) return true;
    release_shell(state, state.tasks.working[kTask]);
    state.hidden_runs.cut_elements[kTask] = 0;
    if (!give_rows(state, 2 * state.region_rests.most_vertices[kTask], false)) return false;
    state.hidden_runs.redo_count[kTask] = 0;
    start_task(state, Blows(1), kTask);
    return true;
}

HitReport finish_hit(RunRows& state, std::span<FragmentPart> parts) {
    Tasks& tasks = state.tasks;
    HitReport report;
    const bool is_quick = is_quick_task(state, kTask);
    const TaskEnergy of_region = is_quick ? region_energy(RegionView(state, kTask)) : TaskEnergy{};
    if (is_quick) {
        close_region(state, kTask, BodyMotion(state, kTask));
        report.awake = state.quick_runs.awake_count[kTask];
    }
    report.steps = tasks.steps_done[kTask];
    report.cuts = tasks.crack_count[kTask];
    report.starts = tasks.start_count[kTask];
    report.redos = state.hidden_runs.redo_count[kTask];
    report.dropped = static_cast<TaskState>(tasks.state[kTask]) == TaskState::Dropped;
    report.cracked = report.cuts > 0;
    const ShellView shell(state, tasks.working[kTask]);
    report.moving = shell.vertex_count();
    const Scratch<std::array<FragmentPart, kMostParts>> parts_of(state.scratch);
    if (parts.empty()) parts = *parts_of;
    report.parts = group_fragments(shell, parts);
    if (report.parts > 1 && !report.dropped && run_out_cracks(state, kTask))
        report.parts = group_fragments(shell, parts);
    tasks.part_count[kTask] = report.parts;
    report.broke = report.parts > 1;
    report.start_energy = state.hidden_runs.start_energy[kTask];
    const TaskEnergy energy = is_quick ? of_region : task_energy(state, kTask);
    report.end_energy = energy.total();
    report.end_kinetic = energy.kinetic + energy.strikers;
    report.impulse = state.task_contacts.impulse[0];
    report.striker_speed_after = static_cast<float>(state.task_contacts.striker_speed[0]);
    return report;
}

HitReport run_hit(RunRows& state, Row<Structures> shell, const HitDescription& hit,
                  bool (*is_over)(const RunRows& rows), std::span<FragmentPart> parts) {
    if (!open_hit(state, shell, hit)) {
        HitReport report;
        report.dropped = true;
        return report;
    }
    const BrittleLoop loop = hit.quick ? make_quick_loop() : make_brittle_loop();
    const Blows none(1);
    LoopWorld world{state, none};
    Tasks& tasks = state.tasks;
    while (static_cast<TaskState>(tasks.state[kTask]) == TaskState::Running) {
        tasks.steps_granted[kTask] = is_over ? 3 : 1u << 20;
        loop.run_alone(world, {kTask, tasks.steps_done[kTask], tasks.steps_granted[kTask], task_goes_on});
        if (is_over && is_over(state)) break;
        if (!widen_hit(state)) tasks.state[kTask] = static_cast<uint8_t>(TaskState::Dropped);
    }
    return finish_hit(state, parts);
}

void close_hit(RunRows& state) {
    release_shell(state, state.tasks.working[kTask]);
    release_shell(state, state.tasks.source[kTask]);
    state.tasks.state[kTask] = static_cast<uint8_t>(TaskState::Free);
}

HitDescription fall_on_floor(const ShellRows& state, Row<Structures> shell, Vec3 down, float speed) {
    const Range vertices = state.shells.vertices[state.shell_of(shell)];
    HitDescription hit;
    float lowest = -1e30f;
    for (uint32_t v = vertices.first; v < vertices.first + vertices.count; ++v) {
        if (state.vertices.element[v] == kNone) continue;
        const float depth = dot(state.vertices.rest[v], down);
        if (depth <= lowest) continue;
        lowest = depth;
        hit.point = state.vertices.rest[v];
    }
    hit.normal = -down;
    hit.velocity = speed * down;
    return hit;
}

Vec3 seeded_direction(uint64_t seed, uint64_t n) {
    const Random random{seed};
    const double z = 2 * random.uniform(n, 0) - 1, angle = 6.283185307179586 * random.uniform(n, 1);
    double sine, cosine;
    sine_cosine(angle, sine, cosine);
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    return Vec3d(r * cosine, z, r * sine).to_float();
}

FirstCrack first_crack(RunRows& state, Row<Structures> shell, Vec3 down) {
    static constexpr float kSpeed = 1;
    HitDescription hit = fall_on_floor(state, shell, down, kSpeed);
    hit.strength_scale = 1e9f;  // may not crack: stresses are compared below
    if (!open_hit(state, shell, hit)) return {};
    const BrittleLoop loop = make_brittle_loop();
    const Blows none(1);
    LoopWorld world{state, none};
    Tasks& tasks = state.tasks;
    const ShellView working(state, tasks.working[kTask]);
    const CrackLimits limits = crack_limits(working, 1);
    const float limit = limits.start;
    float most = 1e-6f;
    double passed = 0, most_force = 0, force = 0;
    while (static_cast<TaskState>(tasks.state[kTask]) == TaskState::Running) {
        tasks.steps_granted[kTask] = 3;
        loop.run_alone(world, {kTask, tasks.steps_done[kTask], 3, task_goes_on});
        const double impulse = state.task_contacts.impulse[0];
        most_force = std::max(most_force, (impulse - passed) / (3 * double{state.hidden_runs.time_step[kTask]}));
        passed = impulse;
        const float before = most;
        // Only a vertex beside an element above the present maximum can raise it; the least strength factor is 0.5.
        for (uint32_t e = 0; e < working.element_count(); ++e) {
            const uint32_t row = working.element(e);
            if (state.elements.principal[row] <= 0.5f * most * limit) continue;
            for (const uint32_t v : state.elements.corner[row]) {
                const float ratio = start_field(working, v, limits.grain).stress /
                                    (limit * state.vertices.strength_factor[working.vertex(v)]);
                most = std::max(most, ratio);
            }
        }
        if (most > before) force = most_force;
    }
    close_hit(state);
    return {kSpeed / most, static_cast<float>(force / double{most})};
}

}  // namespace cullet
