#include "systems/models/metal_shell/systems.hpp"

#include "systems/bodies/blows.hpp"
#include "systems/models/metal_shell/dent/dent.hpp"
#include "systems/structures/shell/group_fragments.hpp"

namespace cullet::metal_shell {
namespace {

constexpr double kLeastSpeed = 0.5;  // m/s

double closing_speed(const BodyRows& rows, Row<Tasks> task, uint32_t c) {
    const Vec3d point(rows.task_contacts.point[c]), normal(rows.task_contacts.normal[c]);
    const Vec3d arm = point - rows.bodies.centre[rows.tasks.body[task]];
    const Vec3d moving = Vec3d(rows.tasks.start_velocity[task]) + cross(Vec3d(rows.tasks.start_spin[task]), arm);
    return double{rows.task_contacts.start_speed[c]} - dot(moving, normal);
}

// The fastest contact says who strikes, and how fast; all that this striker touches say where.
void gather(BodyRows& rows, Row<Tasks> task) {
    const TaskContacts& contacts = rows.task_contacts;
    const Row<Bodies> body = rows.tasks.body[task];
    const uint32_t first = rows.tasks.first_contact[task], end = first + rows.tasks.contact_count[task];
    uint32_t fastest = kNone;
    double speed = kLeastSpeed;
    for (uint32_t c = first; c < end; ++c)
        if (const double closing = closing_speed(rows, task, c); closing > speed) speed = closing, fastest = c;
    if (fastest == kNone) return;
    const Row<Bodies> striker = contacts.striker[fastest];
    const Vec3d normal(contacts.normal[fastest]);
    Vec3d middle;
    uint32_t count = 0;
    for (uint32_t c = first; c < end; ++c) {
        if (contacts.striker[c] != striker || !(dot(Vec3d(contacts.normal[c]), normal) > 0.7)) continue;
        middle += Vec3d(contacts.point[c]), ++count;
    }
    middle = (1.0 / count) * middle;
    const bool is_round = contacts.striker_radius[fastest] > 0;
    if (is_round) middle = Vec3d(contacts.point[fastest]);
    const bool is_held = static_cast<BodyKind>(rows.bodies.kind[body]) != BodyKind::Dynamic;
    const double own = is_held ? 0 : inverse_mass_at(rows.bodies, body, middle, normal);
    const double inverse_mass = own + double{contacts.striker_inverse_mass[fastest]};
    if (!(inverse_mass > 0)) return;  // both stand fast: the game moves one into the other
    MetalRuns& runs = rows.metal_runs;
    runs.shape[task] = static_cast<uint8_t>(is_round ? StrikerShape::Sphere : StrikerShape::Plane);
    runs.point.set(task, middle.to_float());
    runs.push.set(task, normal.to_float());
    runs.radius[task] = contacts.striker_radius[fastest];
    runs.energy[task] = 0.5 * speed * speed / inverse_mass;
}

}  // namespace

void gather_impulses(EachOwn<TaskOpened> opened, BodyRows& rows) {
    const Row<Tasks> task = opened->task;
    const Row<Structures> source = rows.tasks.source[task], working = rows.tasks.working[task];
    copy_shell_rows(rows, rows, source, working, false);
    clear_pack_ends(rows, working);
    copy_metal_rows(rows, rows, source, working);
    gather(rows, task);
}

void work_impact(Of<Tasks> task, BodyRows& rows) {
    const Row<Tasks> t = task.row;
    Tasks& tasks = rows.tasks;
    tasks.steps_granted[t] -= tasks.steps_granted[t] > 0;
    ++tasks.steps_done[t];
    tasks.state[t] = static_cast<uint8_t>(TaskState::Whole);
    MetalRuns& runs = rows.metal_runs;
    if (!(runs.energy[t] > 0)) return;
    const MetalView metal(rows, tasks.working[t]);
    const Striker striker{static_cast<StrikerShape>(runs.shape[t]),
                          Vec3d(runs.point[t]),
                          Vec3d(runs.push[t]),
                          {},
                          double{runs.radius[t]}};
    const Dent dent = work_dent(metal, striker, runs.energy[t]);
    runs.depth[t] = static_cast<float>(dent.depth);
    if (dent.kind != DentKind::None && bake_dent(metal)) tasks.state[t] = static_cast<uint8_t>(TaskState::Reshaped);
}

void group_dented(EachOwn<TaskEnded> ended, RunRows& rows) {
    const Row<Tasks> task = ended->task;
    rows.tasks.part_count[task] = 1;
    if (static_cast<TaskState>(rows.tasks.state[task]) != TaskState::Reshaped) return;
    rows.shell_parts.of_task(task)[0] = whole_part(ShellView(rows, rows.tasks.working[task]));
}

}  // namespace cullet::metal_shell
