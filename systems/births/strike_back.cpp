#include "systems/births/strike_back.hpp"

#include <algorithm>

#include "components/body_id.hpp"
#include "systems/births/limit_energy.hpp"
#include "systems/bodies/blows.hpp"
#include "systems/bodies/coupling.hpp"

namespace cullet {
namespace {

// Impulses and their moment about a body's centre, world axes.
struct Push {
    Vec3d impulse, turn;
    Push operator+(const Push& o) const { return {impulse + o.impulse, turn + o.turn}; }
};

Push push_at(const Bodies& bodies, Row<Bodies> body, Vec3d impulse, Vec3 place) {
    const Vec3 arm = place - to_world(pose_of(bodies, body), bodies.centre[body].to_float());
    return {impulse, cross(Vec3d(arm), impulse)};
}

Motion pushed(const Bodies& bodies, Row<Bodies> body, const Push& push) {
    const Quat turned = bodies.orientation[body];
    const Vec3d turn(rotate(conjugate(turned), push.turn.to_float()));
    return {bodies.velocity[body] + ((1.0 / bodies.mass[body]) * push.impulse).to_float(),
            bodies.spin[body] + rotate(turned, (inverse(bodies.inertia[body]) * turn).to_float())};
}

void give(Bodies& bodies, RigidWorld& rigid, Row<Bodies> body, const Push& push) {
    const Motion motion = pushed(bodies, body, push);
    bodies.velocity.set(body, motion.velocity);
    bodies.spin.set(body, motion.angular_velocity);
    rigid.set_motion(body, motion);
}

// What a body will lose when pay_answers gives it what waits at the contacts of its own task, J.
double answers_loss(const BodyRows& state, Row<Bodies> body) {
    const TaskContacts& contacts = state.task_contacts;
    const uint32_t task = state.bodies.task[body], first = state.tasks.first_contact[task];
    Push sum;
    for (uint32_t c = first; c < first + state.tasks.contact_count[task]; ++c)
        if (contacts.is_answered[c]) sum = sum + Push{contacts.answer[c], contacts.answer_turn[c]};
    return rigid_energy(state.bodies, body) - rigid_energy(state.bodies, body, pushed(state.bodies, body, sum));
}

// What the striker lost at this contact, as light as it was made, after what it did at the task's contacts before it:
// p v - K_cc p^2/2 - sum K_cb p p_b, J.
double share_lost(const TaskContacts& contacts, uint32_t first, uint32_t c) {
    const double p = contacts.impulse[c];
    double speed = contacts.start_speed[c] - 0.5 * contacts.striker_inverse_mass[c] * p;
    for (uint32_t b = first; b < c; ++b)
        if (share_a_striker(contacts, c, b)) speed -= coupling(contacts, c, b) * contacts.impulse[b];
    return p * speed;
}

// A striker that broke after the run had opened is lighter than the run takes it for. It takes the part of this push,
// which is against the contact's `normal` (world), that gives it the speed there that the run gave it: the whole would
// throw it off with more energy than the body had.
double part_taken(const Bodies& bodies, const TaskContacts& contacts, uint32_t c, const Push& whole, Vec3 normal,
                  Vec3 place) {
    constexpr double kRounding = 1e-5;
    const Row<Bodies> striker = contacts.striker[c];
    const double sharers = std::max<double>(1, contacts.sharers[c]);
    if (bodies.mass[striker] * contacts.striker_own_inverse_mass[c] > (1 - kRounding) * sharers) return 1;
    const Motion now = pushed(bodies, striker, whole);
    const Vec3 arm = place - centre_of(bodies, striker);
    const Vec3 gained =
        now.velocity - bodies.velocity[striker] + cross(now.angular_velocity - bodies.spin[striker], arm);
    const double gain = -dot(Vec3d(gained), Vec3d(normal)),
                 wanted = contacts.impulse[c] * contacts.striker_inverse_mass[c] / sharers;
    return gain > wanted ? wanted / gain : 1;
}

// A striker gives each task its share alone, whatever the order in which they end; what it has lost beyond it waits
// with the next task that shares it, and says that no energy was made by it.
void hand_on(RunRows& state, Row<Tasks> task, uint32_t contact, double surplus) {
    TaskContacts& contacts = state.task_contacts;
    surplus += contacts.answer_energy[contact];
    contacts.answer_energy[contact] = 0;
    if (contacts.sharers[contact] == 0) return;
    for (uint32_t t = 0; t < state.tasks.size(); ++t) {
        if (task == t || static_cast<TaskState>(state.tasks.state[t]) == TaskState::Free || state.tasks.is_late[t] ||
            is_ahead(state.tasks, t))
            continue;
        const uint32_t end = state.tasks.first_contact[t] + state.tasks.contact_count[t];
        for (uint32_t c = state.tasks.first_contact[t]; c < end; ++c)
            if (contacts.sharers[c] > 0 && contacts.striker[c] == contacts.striker[contact]) {
                contacts.answer_energy[c] += surplus;
                return;
            }
    }
}

// The first contact of the striker's own task with `body`, which keeps what the striker is owed, or kNone: it has none,
// or the rigid solver has dealt with it already. All of that task's contacts with the body count as answered.
uint32_t answering_contact(BodyRows& state, Row<Bodies> striker, Row<Bodies> body, bool is_heir) {
    const uint32_t t = state.bodies.task[striker];
    if (t == kNone || state.tasks.is_late[t] || is_ahead(state.tasks, t)) return kNone;
    uint32_t found = kNone;
    const uint32_t first = state.tasks.first_contact[t];
    for (uint32_t c = first; c < first + state.tasks.contact_count[t]; ++c) {
        if (state.task_contacts.striker[c] != body) continue;
        state.task_contacts.is_answered[c] = 1;
        state.task_contacts.is_heir_striker[c] = is_heir;
        found = std::min(found, c);
    }
    return found;
}

// One striker that broke first passed something, and the run of this body passed something there. The difference of the
// two goes to its largest piece, where that is the larger one's and gets slower by it. The pieces of this body have no
// energy to pay for it. Returns what this body's own heir has to take, body axes; `allowed` follows. Its contacts are
// answered then.
Vec3d settle_answers(Births& births, Row<Tasks> task, const Pose& pose, uint32_t contact, double& allowed) {
    auto& state = births.state;
    TaskContacts& contacts = state.task_contacts;
    const Row<Bodies> striker = contacts.striker[contact];
    Vec3d missing;
    uint32_t hardest = contact;
    const uint32_t first = state.tasks.first_contact[task];
    for (uint32_t c = contact; c < first + state.tasks.contact_count[task]; ++c) {
        if (!contacts.is_answered[c] || contacts.striker[c] != striker) continue;
        const Vec3d blow = contacts.impulse[c] * Vec3d(contacts.normal[c]);
        missing += contacts.answer[c] - Vec3d(rotate(pose.orientation, blow.to_float()));
        allowed += contacts.answer_energy[c];
        contacts.answer_energy[c] = 0;
        contacts.is_answered[c] = 0;
        if (contacts.impulse[c] > contacts.impulse[hardest]) hardest = c;
    }
    if (contacts.is_heir_striker[contact] && is_dynamic(state.bodies, striker)) {
        const Push owed = push_at(state.bodies, striker, missing, to_world(pose, contacts.point[hardest]));
        const double lost = rigid_energy(state.bodies, striker) -
                            rigid_energy(state.bodies, striker, pushed(state.bodies, striker, owed));
        if (lost > 0) {
            give(state.bodies, births.rigid, striker, owed);
            allowed += lost;
            return {};
        }
    }
    return Vec3d(rotate(conjugate(pose.orientation), missing.to_float()));
}

}  // namespace

// What the pins took during the run is what is missing from the pieces: hidden steps keep momentum to rounding, 1e-5 to
// 9e-5 of the blow's in 2,000 steps. It is lost in plain steps (cuts lose 3e-6, contacts 4e-7), and not by the speed of
// the body, whose own frame does as badly. Stiffness entries are floats. So a vertex's column of blocks is off its row
// by 2e-8, and pieces that turn pull on that with all their displacement. Uncracked bodies lose 1e-7 to 1e-6.
double strike_back(Births& births, const Break& plan, const Pose& pose) {
    auto& state = births.state;
    Fragments& f = births.fragments;
    const Row<Tasks> task = plan.task;
    const Row<Fragments> heir = plan.largest;
    const Row<Bodies> body = state.tasks.body[task];
    TaskContacts& contacts = state.task_contacts;
    Vec3d to_static, came_in, moving, difference;
    double allowed = rigid_energy(state.bodies, body);
    const uint32_t first = state.tasks.first_contact[task];
    bool was_answered[kMostContacts] = {};
    for (uint32_t c = first; c < first + state.tasks.contact_count[task]; ++c)
        was_answered[c - first] = contacts.is_answered[c];
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
            difference += settle_answers(births, task, pose, c, allowed);
        }
        if (was_answered[c - first]) continue;
        if (!is_dynamic(state.bodies, striker) || !(contacts.striker_inverse_mass[c] > 0)) {
            to_static += -1.0 * blow;
            if (is_dynamic(state.bodies, striker)) continue;
            allowed += given;  // a lift, or what the game pushes with
            births.counts.work_from_outside += given;
            continue;
        }
        const Push whole = push_at(state.bodies, striker, -1.0 * in_world, place);
        const Vec3 normal = rotate(pose.orientation, contacts.normal[c]);
        const double part = part_taken(state.bodies, contacts, c, whole, normal, place);
        const Push taken{part * whole.impulse, part * whole.turn};
        difference += (part - 1) * blow;
        // Ties to the one that broke first.
        const bool is_larger = state.bodies.mass[body] >= state.bodies.mass[striker];
        const uint32_t waits = answering_contact(state, striker, body, is_larger && !f.has_pins[heir]);
        double lost;
        if (waits == kNone) {
            give(state.bodies, births.rigid, striker, taken);
            lost = before - rigid_energy(state.bodies, striker);
        } else {
            const double lost_before = answers_loss(state, striker);
            contacts.answer.set(waits, contacts.answer[waits] + taken.impulse);
            contacts.answer_turn.set(waits, contacts.answer_turn[waits] + taken.turn);
            lost = answers_loss(state, striker) - lost_before;
            contacts.answer_energy[waits] -= lost;
        }
        const double share = contacts.sharers[c] > 0 && part == 1 ? share_lost(contacts, first, c) : lost;
        allowed += share;
        hand_on(state, task, c, lost - share);
    }
    // What the game's blows gave comes from outside: pushes are booked above, as contacts with nobody.
    const Vec3d exploded = take_explosions(births.blows, task);
    came_in += exploded;
    to_static += -1.0 * exploded;
    bool is_pinned = false;
    for (const Row<Fragments> row : plan.fragments) {
        is_pinned = is_pinned || f.has_pins[row];
        if (!f.has_pins[row]) moving += f.momentum[row];
    }
    Vec3d inherited = f.momentum[heir];
    if (is_pinned) {
        to_static += came_in - moving;
        (f.has_pins[heir] ? to_static : inherited) += difference;
    } else {
        const Vec3d start = state.bodies.mass[body] * Vec3d(state.tasks.start_velocity[task]);
        const Vec3d rounding = start + came_in - moving;
        const double scale = std::max(length(start), length(came_in));
        births.counts.worst_rounding =
            std::max(births.counts.worst_rounding, scale > 0 ? length(rounding) / scale : 0.0);
        inherited += rounding + difference;
    }
    f.momentum.set(heir, inherited);
    f.velocity.set(heir, (1 / f.moving_mass[heir]) * inherited);
    const Vec3d booked(rotate(pose.orientation, to_static.to_float()));
    for (int k = 0; k < 3; ++k) births.counts.impulse_to_static[k] += booked[k];
    return allowed;
}

void pay_answers(Bodies& bodies, const Tasks& tasks, TaskContacts& contacts, RigidWorld& rigid, Row<Tasks> task) {
    const Row<Bodies> body = tasks.body[task];
    for (uint32_t c = tasks.first_contact[task]; c < tasks.first_contact[task] + tasks.contact_count[task]; ++c) {
        if (!contacts.is_answered[c]) continue;
        if (is_dynamic(bodies, body) && length(contacts.answer[c]) > 0)
            give(bodies, rigid, body, {contacts.answer[c], contacts.answer_turn[c]});
        contacts.answer.set(c, {});
        contacts.answer_turn.set(c, {});
        contacts.answer_energy[c] = 0;
        contacts.is_answered[c] = 0;
    }
}

}  // namespace cullet
