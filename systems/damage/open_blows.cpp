#include "systems/damage/open_blows.hpp"

#include <algorithm>

#include "systems/damage/blows.hpp"
#include "systems/damage/thresholds.hpp"
#include "systems/rigid/body_id.hpp"

namespace cullet {
namespace {

bool has_free_task(const Tasks& tasks) {
    for (uint32_t t = 0; t < tasks.size(); ++t)
        if (static_cast<TaskState>(tasks.state[t]) == TaskState::Free) return true;
    return false;
}

ImpactEvent event_of(const State& state, uint32_t row) {
    const Blows& blows = state.blows;
    const Row<Bodies> body = blows.body[row];
    const Pose pose = pose_of(state.bodies, body);
    ImpactEvent e;
    e.body = body_id(state.bodies, body);
    e.body_user_data = state.bodies.user_data[body];
    e.place = to_world(pose, blows.point[row]);
    e.normal = rotate(pose.orientation, blows.direction[row]);
    e.approach_speed = blows.speed[row];
    const double speed = blows.speed[row], size = length(blows.impulse[row]);
    if (is_kind(blows, row, BlowKind::Push))
        e.energy = 0.5 * speed * speed / (double{blows.inverse_mass[row]} + 1 / state.bodies.mass[body]);
    else
        e.energy = 0.5 * size * size / state.bodies.mass[body];
    return e;
}

// Whether a task of this step, or one that is to be opened, can take the blow too.
bool fits(const State& state, uint32_t row, uint32_t t, bool is_late) {
    if (is_kind(state.blows, row, BlowKind::Cut) != is_cut_task(state.blows, Row<Tasks>(t))) return false;
    if (is_kind(state.blows, row, BlowKind::Push) && state.tasks.contact_count[t] == kMostContacts) return false;
    return is_late || is_kind(state.blows, row, BlowKind::Cut) ||
           !state.blows.is_paid[row];  // what was paid must not come a second time from the run
}

void lay_push(State& state, uint32_t row, uint32_t t) {
    Tasks& tasks = state.tasks;
    const Blows& blows = state.blows;
    TaskContacts& contacts = state.task_contacts;
    const Row<Shells> shell = tasks.source[t];
    const uint32_t c = tasks.first_contact[t] + tasks.contact_count[t]++;
    const Vec3 arm = blows.point[row] - state.bodies.centre[tasks.body[t]].to_float();
    const Vec3 moving = tasks.start_velocity[t] + cross(tasks.start_spin[t], arm);
    contacts.clear_rows(c, 1);
    contacts.point.set(c, blows.point[row]);
    contacts.normal.set(c, blows.direction[row]);
    contacts.striker[c] = {};
    contacts.striker_inverse_mass[c] = blows.inverse_mass[row];
    contacts.striker_radius[c] = blows.radius[row];
    contacts.start_speed[c] = dot(moving, blows.direction[row]) + blows.speed[row];
    contacts.radius[c] =
        std::max({3 * state.shells.thickness[shell], 1.3f * state.shells.mean_edge[shell], 0.35f * blows.radius[row]});
}

enum class Outcome : uint8_t { Waits, Joined, Gone };

struct Opener {
    BlowOpening& o;

    // What sleeps may lose its support to a cut.
    void wake(Row<Bodies> body) {
        if (static_cast<BodyKind>(o.state.bodies.kind[body]) != BodyKind::Dynamic) return;
        o.rigid.wake(body);
        o.state.bodies.is_asleep[body] = 0;
    }
    void pay(uint32_t row) { pay_blow(o.state.blows, o.state.bodies, o.rigid, o.counts, row); }

    void join(uint32_t row, uint32_t t) {
        Tasks& tasks = o.state.tasks;
        if (tasks.is_late[t]) pay(row);
        wake(tasks.body[t]);
        o.state.blows.task[row] = t;
        if (is_kind(o.state.blows, row, BlowKind::Cut)) return;
        if (is_kind(o.state.blows, row, BlowKind::Push))
            lay_push(o.state, row, t);
        else
            tasks.quiet_time[t] = tasks.end_time[t];  // no touch tells when it is over
        tasks.approach_speed[t] = std::max(tasks.approach_speed[t], o.state.blows.speed[row]);
        o.impact_events.push(event_of(o.state, row));
    }

    /// New ones that damage is not worth looking at for, or is forbidden for.
    bool is_harmless(uint32_t row) const {
        const State& state = o.state;
        const Row<Bodies> body = state.blows.body[row];
        if (state.blows.speed[row] <=
            wake_speed(state.shells, state.bodies.shell[body], state.bodies.strength_scale[body]))
            return true;
        if (!may_break_again(state.shells, state.bodies.shell[body], o.settings)) return true;
        return o.settings.allows && !o.settings.allows(o.settings.allows_user, event_of(state, row));
    }

    Outcome look_at(uint32_t row) {
        State& state = o.state;
        Blows& blows = state.blows;
        const Row<Bodies> body = blows.body[row];
        const bool is_cut = is_kind(blows, row, BlowKind::Cut), is_new = !blows.is_taken[row];
        blows.is_taken[row] = 1;
        if (!is_cut && is_new && is_harmless(row)) {
            pay(row);
            return Outcome::Gone;
        }
        if (!is_cut && !may_break_again(state.shells, state.bodies.shell[body], o.settings)) return Outcome::Gone;
        const uint32_t open = state.bodies.task[body];
        if (open != kNone) {
            const bool is_fresh = state.tasks.opened_frame[open] == o.frame;
            if (is_fresh && fits(state, row, open, state.tasks.is_late[open])) {
                join(row, open);
                return Outcome::Joined;
            }
        } else if (!state.bodies.hold_count[body] && o.frame >= state.bodies.retry_frame[body] &&
                   has_free_task(state.tasks)) {
            const Row<Tasks> task = o.open(o.opener, body, is_cut ? 1.0f : blows.speed[row]);
            if (!task.exists()) {
                pay(row);
                return Outcome::Gone;
            }
            state.tasks.is_late[task] = !is_cut && blows.is_paid[row];
            join(row, task);
            return Outcome::Joined;
        }
        pay(row);
        return Outcome::Waits;
    }
};

}  // namespace

void open_blows(BlowOpening& opening) {
    Blows& blows = opening.state.blows;
    Opener opener{opening};
    for (uint32_t row = 0; row < blows.size();) {
        if (blows.task[row] == kNone && opener.look_at(row) == Outcome::Gone)
            remove_blow(blows, row);
        else
            ++row;
    }
}

}  // namespace cullet
