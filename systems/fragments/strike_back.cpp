#include "systems/fragments/strike_back.hpp"

#include <algorithm>

#include "systems/damage/blows.hpp"
#include "systems/fragments/limit_energy.hpp"
#include "systems/rigid/body_id.hpp"

namespace cullet {
namespace {

bool is_dynamic(const Bodies& bodies, Row<Bodies> b) {
    return b.exists() && static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Dynamic;
}

void push(Bodies& bodies, RigidWorld& rigid, Row<Bodies> body, Vec3 impulse, Vec3 place) {
    const Pose pose = pose_of(bodies, body);
    const Vec3 arm = place - to_world(pose, bodies.centre[body].to_float());
    const Vec3d turn(rotate(conjugate(pose.orientation), cross(arm, impulse)));
    bodies.velocity.set(body, bodies.velocity[body] + static_cast<float>(1.0 / bodies.mass[body]) * impulse);
    bodies.spin.set(body,
                    bodies.spin[body] + rotate(pose.orientation, (inverse(bodies.inertia[body]) * turn).to_float()));
    rigid.set_motion(body, {bodies.velocity[body], bodies.spin[body]});
}

// The contact of the striker's own task with `body` that keeps what the striker is owed, or kNone: it has none, or the
// rigid solver has dealt with it already. All of that task's contacts with the body count as answered.
uint32_t answering_contact(State& state, Row<Bodies> striker, Row<Bodies> body) {
    const uint32_t t = state.bodies.task[striker];
    if (t == kNone || state.tasks.is_late[t]) return kNone;
    uint32_t found = kNone;
    const uint32_t first = state.tasks.first_contact[t];
    for (uint32_t c = first; c < first + state.tasks.contact_count[t]; ++c) {
        if (state.task_contacts.striker[c] != body) continue;
        state.task_contacts.is_answered[c] = 1;
        found = std::min(found, c);
    }
    return found;
}

}  // namespace

// What the pins took during the run is what is missing from the pieces: hidden steps keep momentum to rounding, 1e-5 to
// 9e-5 of the blow's in 2,000 steps. It is lost in plain steps (cuts lose 3e-6, contacts 4e-7), and not by the speed of
// the body, whose own frame does as badly: stiffness entries are floats, so a vertex's column of blocks is off its row
// by 2e-8, and pieces that turn pull on that with all their displacement. Uncracked bodies lose 1e-7 to 1e-6.
double strike_back(Births& births, Row<Tasks> task, const Pose& pose, std::span<PartMotion> motions, uint32_t largest) {
    State& state = births.state;
    const Row<Bodies> body = state.tasks.body[task];
    TaskContacts& contacts = state.task_contacts;
    PartMotion& heir = motions[largest];
    Vec3d to_static, came_in, moving, difference;
    double allowed = rigid_energy(state.bodies, body);
    const uint32_t first = state.tasks.first_contact[task];
    for (uint32_t c = first; c < first + state.tasks.contact_count[task]; ++c) {
        const Row<Bodies> striker = contacts.striker[c];
        const Vec3d blow = contacts.impulse[c] * Vec3d(contacts.normal[c]);
        const Vec3d in_world(rotate(pose.orientation, blow.to_float()));
        // What pushes a ball without friction points at its centre, wherever its surface has the contact's normal.
        const bool is_ball = striker.exists() && state.bodies.is_sphere[striker];
        const Vec3 place = is_ball ? centre_of(state.bodies, striker) : to_world(pose, contacts.point[c]);
        const double given = contacts.impulse[c] * 0.5 * (contacts.start_speed[c] + contacts.striker_speed[c]);
        const double before = rigid_energy(state.bodies, striker);
        came_in += blow;
        if (contacts.is_answered[c]) {
            const Vec3d missing = contacts.answer[c] - in_world;
            allowed += contacts.answer_energy[c];
            contacts.answer_energy[c] = 0;
            if (contacts.is_heir_striker[c] && is_dynamic(state.bodies, striker)) {
                push(state.bodies, births.rigid, striker, missing.to_float(), place);
                allowed += before - rigid_energy(state.bodies, striker);
            } else {
                difference += Vec3d(rotate(conjugate(pose.orientation), missing.to_float()));
            }
            contacts.is_answered[c] = 0;
            continue;
        }
        if (!is_dynamic(state.bodies, striker) || !(contacts.striker_inverse_mass[c] > 0)) {
            to_static += -1.0 * blow;
            if (!is_dynamic(state.bodies, striker)) allowed += given;  // a lift, or what the game pushes with
            continue;
        }
        const uint32_t waits = answering_contact(state, striker, body);
        if (waits == kNone) {
            push(state.bodies, births.rigid, striker, (-1.0 * in_world).to_float(), place);
            allowed += before - rigid_energy(state.bodies, striker);
            continue;
        }
        allowed += given;
        contacts.answer_energy[waits] -= given;
        contacts.answer.set(waits, contacts.answer[waits] - in_world);
        // Ties to the one that broke first.
        const bool is_larger = state.bodies.mass[body] >= state.bodies.mass[striker];
        contacts.is_heir_striker[waits] = is_larger && !heir.is_static;
    }
    // What the game's blows gave comes from outside: pushes are booked above, as contacts with nobody.
    const Vec3d exploded = take_explosions(state.blows, task);
    came_in += exploded;
    to_static += -1.0 * exploded;
    bool is_pinned = false;
    for (const PartMotion& m : motions) {
        is_pinned = is_pinned || m.is_static;
        if (!m.is_static) moving += m.momentum;
    }
    if (is_pinned) {
        to_static += came_in - moving;
        (heir.is_static ? to_static : heir.momentum) += difference;
    } else {
        const Vec3d start = state.bodies.mass[body] * Vec3d(state.tasks.start_velocity[task]);
        const Vec3d rounding = start + came_in - moving;
        const double scale = std::max(length(start), length(came_in));
        births.counts.worst_rounding =
            std::max(births.counts.worst_rounding, scale > 0 ? length(rounding) / scale : 0.0);
        heir.momentum += rounding + difference;
    }
    heir.velocity = (1 / heir.mass) * heir.momentum;
    const Vec3d booked(rotate(pose.orientation, to_static.to_float()));
    for (int k = 0; k < 3; ++k) births.counts.impulse_to_static[k] += booked[k];
    return allowed;
}

void pay_answers(Bodies& bodies, const Tasks& tasks, TaskContacts& contacts, RigidWorld& rigid, Row<Tasks> task) {
    const Row<Bodies> body = tasks.body[task];
    for (uint32_t c = tasks.first_contact[task]; c < tasks.first_contact[task] + tasks.contact_count[task]; ++c) {
        if (!contacts.is_answered[c]) continue;
        if (is_dynamic(bodies, body) && length(contacts.answer[c]) > 0)
            push(bodies, rigid, body, contacts.answer[c].to_float(),
                 to_world(pose_of(bodies, body), contacts.point[c]));
        contacts.answer.set(c, {});
        contacts.answer_energy[c] = 0;
        contacts.is_answered[c] = 0;
    }
}

}  // namespace cullet
