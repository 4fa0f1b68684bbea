#include "tests/models/halves/systems.hpp"

#include "systems/bodies/blows.hpp"
#include "systems/structures/shell/cut_shell.hpp"
#include "systems/structures/shell/group_fragments.hpp"

namespace cullet::halves {
namespace {

/// Of its vertices: momenta are theirs.
Vec3d centre_of_vertices(const ShellView& shell) {
    const Vertices& vertices = shell.state.vertices;
    double mass = 0;
    Vec3d sum;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        mass += vertices.mass[shell.vertex(v)];
        sum += vertices.mass[shell.vertex(v)] * Vec3d(vertices.rest[shell.vertex(v)]);
    }
    return (1 / mass) * sum;
}

void move_as(const ShellView& shell, Vec3d centre, Vec3d velocity, Vec3d spin) {
    Vertices& vertices = shell.state.vertices;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        if (vertices.element[row] == kNone) continue;
        vertices.velocity.set(row, (velocity + cross(spin, Vec3d(vertices.rest[row]) - centre)).to_float());
    }
}

/// Across the plane along which the thing comes apart: it holds the blow, and as much as possible of one axis.
Vec3 normal_of_cut(Vec3 blow) {
    const Vec3 size{std::fabs(blow.x), std::fabs(blow.y), std::fabs(blow.z)};
    const Vec3 axis = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0}
                      : size.y <= size.z                   ? Vec3{0, 1, 0}
                                                           : Vec3{0, 0, 1};
    return normalised(cross(blow, axis));
}

void cut(BodyRows& rows, Row<Tasks> task, const CutSurface& surface) {
    const CutReport report =
        cut_shell(ShellView(rows, rows.tasks.working[task]), surface, rows.pin_boxes, {}, kNoRepair);
    rows.tasks.crack_count[task] += report.cut_edges;
    rows.tasks.lacks_room[task] = report.is_full;
}

/// Along the game's own cuts, or along the blow; explosions only push.
void cut_along_blow(BodyRows& rows, const Blows& blows, Row<Tasks> task) {
    if (is_cut_task(blows, task)) {
        for (uint32_t b = 0; b < blows.size(); ++b)
            if (blows.task[b] == task.index) cut(rows, task, CutSurface(blows, b));
        return;
    }
    if (rows.tasks.contact_count[task] == 0) return;
    const uint32_t first = rows.tasks.first_contact[task];
    const Vec3 normal = normal_of_cut(rows.task_contacts.normal[first]);
    cut(rows, task, CutSurface(rows.task_contacts.point[first], normal));
}

}  // namespace

void copy_wholes(EachOwn<TaskOpened> opened, RunRows& rows) {
    const Row<Tasks> task = opened->task;
    const Row<Structures> source = rows.tasks.source[task], working = rows.tasks.working[task];
    copy_shell_rows(rows, rows, source, working, false);
    clear_pack_ends(rows, working);
    const ShellView shell(rows, working);
    move_as(shell, centre_of_vertices(shell), Vec3d(rows.tasks.start_velocity[task]),
            Vec3d(rows.tasks.start_spin[task]));
}

// As two bodies that stick to each other: J = speed of approach / (1/m of the striker + 1/m of the body there).
void push_wholes(EachOwn<TaskOpened> opened, BodyRows& rows) {
    const Row<Tasks> task = opened->task;
    if (rows.tasks.contact_count[task] == 0) return;
    const ShellView shell(rows, rows.tasks.working[task]);
    TaskContacts& contacts = rows.task_contacts;
    const uint32_t c = rows.tasks.first_contact[task];
    const Row<Bodies> body = rows.tasks.body[task];
    const Vec3d normal(contacts.normal[c]), centre = centre_of_vertices(shell), arm = Vec3d(contacts.point[c]) - centre,
                                            turn = cross(arm, normal), velocity(rows.tasks.start_velocity[task]),
                                            spin(rows.tasks.start_spin[task]);
    const Sym3d inverse_inertia = inverse(rows.bodies.inertia[body]);
    const double inverse_mass =
        contacts.striker_inverse_mass[c] + 1 / rows.bodies.mass[body] + dot(turn, inverse_inertia * turn);
    const double closing = contacts.start_speed[c] - dot(velocity + cross(spin, arm), normal);
    const double impulse = std::max(closing, 0.0) / inverse_mass;
    contacts.impulse[c] = impulse;
    contacts.striker_speed[c] = contacts.start_speed[c] - impulse * contacts.striker_inverse_mass[c];
    move_as(shell, centre, velocity + (impulse / rows.bodies.mass[body]) * normal,
            spin + inverse_inertia * (impulse * turn));
}

void run_crack(Of<Tasks> task, BodyRows& rows, const Blows& blows) {
    const Row<Tasks> t = task.row;
    Tasks& tasks = rows.tasks;
    tasks.steps_granted[t] -= tasks.steps_granted[t] > 0;
    if (static_cast<float>(++tasks.steps_done[t]) * rows.hidden_runs.time_step[t] <= rows.hidden_runs.end_time[t])
        return;
    cut_along_blow(rows, blows, t);
    tasks.state[t] = static_cast<uint8_t>(TaskState::Whole);  // find_halves tells whether it broke
}

void find_halves(EachOwn<TaskEnded> ended, RunRows& rows) {
    const Row<Tasks> task = ended->task;
    Tasks& tasks = rows.tasks;
    tasks.part_count[task] = 1;
    if (static_cast<TaskState>(tasks.state[task]) == TaskState::Dropped || tasks.crack_count[task] == 0) return;
    const std::span<FragmentPart> parts = rows.shell_parts.of_task(task);
    const uint32_t count = tasks.part_count[task] = group_fragments(ShellView(rows, tasks.working[task]), parts);
    if (count > 1) tasks.state[task] = static_cast<uint8_t>(count > kMostParts ? TaskState::Dropped : TaskState::Broke);
}

}  // namespace cullet::halves
