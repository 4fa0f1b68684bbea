#include "systems/models/thick_shell/hidden/start_hidden.hpp"

#include "systems/models/thick_shell/hidden/energy.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/stiffness/element_stress.hpp"

namespace cullet {
namespace {

void set_motion(Vertices& vertices, uint32_t row, Vec3 velocity, float beta) {
    const Vec3 probe = beta * velocity;
    vertices.displacement.set(row, {});
    vertices.velocity.set(row, velocity);
    vertices.crush[row] = 0;
    for (int side = 0; side < 2; ++side) vertices.probe.set(row, {probe.x, probe.y, probe.z, 0}, side);
}

// Of the vertices' masses, which stand on the outer side: half a wall away from the prisms' centre in a flat piece.
Vec3d centre_of_vertices(const ShellView& shell) {
    const Vertices& vertices = shell.state.vertices;
    double mass = 0;
    Vec3d sum;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        if (vertices.element[row] == kNone) continue;
        mass += vertices.mass[row];
        sum += vertices.mass[row] * Vec3d(vertices.rest[row]);
    }
    return mass > 0 ? (1 / mass) * sum : Vec3d{};
}

}  // namespace

// Bodies turn about the centre of the masses that the run knows. About the prisms' centre a spinning shard would begin
// with up to a fifth more or less momentum than the rigid body has.
void start_hidden(RunRows& state, Row<Tasks> task) {
    Tasks& tasks = state.tasks;
    const ShellView shell(state, tasks.working[task]);
    Vertices& vertices = state.vertices;
    const bool is_region = is_hidden_region(state, task);
    const Vec3d centre = is_region ? state.region_rests.body_centre[task] : centre_of_vertices(shell),
                velocity(tasks.start_velocity[task]), spin(tasks.start_spin[task]);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        const bool is_free = vertices.inverse_mass[row] > 0;
        const Vec3d motion = velocity + cross(spin, Vec3d(vertices.rest[row]) - centre);
        set_motion(vertices, row, is_free ? motion.to_float() : Vec3{}, state.hidden_runs.damping_time[task]);
    }
    if (is_region) start_rest(state, task);
    TaskContacts& contacts = state.task_contacts;
    for (uint32_t c = tasks.first_contact[task]; c < tasks.first_contact[task] + tasks.contact_count[task]; ++c) {
        contacts.striker_travel[c] = contacts.impulse[c] = 0;
        contacts.striker_speed[c] = contacts.start_speed[c];
    }
    tasks.steps_done[task] = 0;
    link_slopes(shell);
    state.hidden_runs.start_energy[task] = task_energy(state, task).total();
}

}  // namespace cullet
