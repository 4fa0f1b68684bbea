#include "systems/births/fragment_motions.hpp"

#include <algorithm>

#include "systems/births/limit_energy.hpp"
#include "systems/births/part_motion.hpp"
#include "systems/births/settle_momenta.hpp"
#include "systems/bodies/blows.hpp"

namespace cullet {
namespace {

// A contact is not solved where the striker breaks too, on time and at this body: what the touch takes is in the motion
// of the striker's pieces, in this frame or since one before it.
bool goes_to_striker(const Tasks& tasks, const TaskContacts& contacts, const Bodies& bodies, Row<Bodies> body,
                     uint32_t contact) {
    if (contacts.is_answered[contact]) return true;
    const Row<Bodies> striker = contacts.striker[contact];
    const uint32_t own = striker.exists() ? bodies.task[striker] : kNone;
    if (own == kNone || static_cast<TaskState>(tasks.state[own]) != TaskState::Broke || tasks.is_late[own])
        return false;
    const uint32_t first = tasks.first_contact[own], end = first + tasks.contact_count[own];
    for (uint32_t c = first; c < end; ++c)
        if (contacts.striker[c] == body) return true;
    return false;
}

void stand_still(Fragments& f, uint32_t row) {
    f.moving_mass[row] = f.radius[row] = f.hidden_energy[row] = f.crushed_energy[row] = 0;
    f.inertia[row] = {};
    for (auto* column : {&f.centre, &f.momentum, &f.turning, &f.velocity, &f.spin, &f.free_momentum, &f.free_spin})
        column->set(row, {});
}

}  // namespace

void move_with_body(Planning& planning, const Break& plan, Vec3d velocity, Vec3d spin) {
    Fragments& f = planning.fragments;
    planning.calls(plan).weigh(planning.state, plan, f);
    const Vec3d body_centre = planning.state.bodies.centre[plan.body];
    for (const Row<Fragments> row : plan.fragments) {
        if (f.has_pins[row]) continue;
        const Vec3d own = velocity + cross(spin, f.centre[row] - body_centre);
        f.spin.set(row, spin);
        f.velocity.set(row, own);
        f.momentum.set(row, f.moving_mass[row] * own);
    }
}

// P and L stay; the mass lies otherwise. What is not dented stays where it was, so the middle moves, and the momentum's
// moment with it: the spin makes up for that.
void move_reshaped(Planning& planning, const Break& plan, Vec3d velocity, Vec3d spin) {
    Fragments& f = planning.fragments;
    planning.calls(plan).weigh(planning.state, plan, f);
    const Bodies& bodies = planning.state.bodies;
    const Sym3d before = bodies.inertia[plan.body];
    for (const Row<Fragments> row : plan.fragments) {
        if (f.has_pins[row]) continue;
        const Vec3d momentum = f.moving_mass[row] * velocity;
        const Vec3d moved = f.centre[row] - bodies.centre[plan.body];
        f.spin.set(row, inverse(f.inertia[row]) * (before * spin - cross(moved, momentum)));
        f.velocity.set(row, velocity);
        f.momentum.set(row, momentum);
    }
}

void settle(Planning& planning, Break& plan) {
    if (plan.is_settled) return;
    settle_momenta(planning.fragments, plan.fragments, planning.touches, plan.start, planning.state.scratch);
    plan.is_settled = true;
}

void join_motions(Fragments& f, Row<Fragments> fragment, Row<Fragments> joined) {
    const double mass = f.moving_mass[fragment] + f.moving_mass[joined];
    f.crushed_energy[fragment] += f.crushed_energy[joined];
    if (!(mass > 0)) return stand_still(f, joined);
    const bool is_static = f.has_pins[fragment] || f.has_pins[joined];
    const Vec3d centre =
        (1 / mass) * (f.moving_mass[fragment] * f.centre[fragment] + f.moving_mass[joined] * f.centre[joined]);
    Sym3d inertia;
    Vec3d turning;
    for (const Row<Fragments> row : {fragment, joined}) {
        const Vec3d arm = f.centre[row] - centre;
        inertia = inertia + f.inertia[row] + f.moving_mass[row] * inertia_of(outer(arm));
        turning += f.inertia[row] * f.spin[row] + cross(arm, f.momentum[row]);
    }
    const Vec3d momentum = is_static ? Vec3d{} : f.momentum[fragment] + f.momentum[joined];
    f.moving_mass[fragment] = mass;
    f.centre.set(fragment, centre);
    f.inertia[fragment] = inertia;
    f.momentum.set(fragment, momentum);
    f.velocity.set(fragment, (1 / mass) * momentum);
    if (is_static)
        f.spin.set(fragment, {});
    else if (can_turn(inertia))
        f.spin.set(fragment, inverse(inertia) * turning);
    stand_still(f, joined);
}

double lost_to_touch(const BodyRows& state, Row<Tasks> task) {
    if (state.tasks.is_late[task]) return owed_to_late(state, task);
    const TaskContacts& contacts = state.task_contacts;
    const Row<Bodies> body = state.tasks.body[task];
    const uint32_t first = state.tasks.first_contact[task], end = first + state.tasks.contact_count[task];
    double most = 0;
    for (uint32_t c = first; c < end; ++c) {
        if (goes_to_striker(state.tasks, contacts, state.bodies, body, c)) continue;
        const Vec3d point(contacts.point[c]), normal(contacts.normal[c]);
        const Vec3d arm = point - state.bodies.centre[body];
        const Vec3d moving = Vec3d(state.tasks.start_velocity[task]) + cross(Vec3d(state.tasks.start_spin[task]), arm);
        const double speed = double{contacts.start_speed[c]} - dot(moving, normal);
        const double inverse_mass =
            inverse_mass_at(state.bodies, body, point, normal) + double{contacts.striker_inverse_mass[c]};
        const Row<Bodies> striker = contacts.striker[c];
        const double bounce =
            striker.exists() ? double{state.bodies.restitution[body]} * state.bodies.restitution[striker] : 1;
        if (speed > 0 && inverse_mass > 0)
            most = std::max(most, 0.5 * (1 - bounce * bounce) * 0.5 * speed * speed / inverse_mass);
    }
    return most;
}

}  // namespace cullet
