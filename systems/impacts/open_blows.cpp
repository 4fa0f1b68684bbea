#include "systems/impacts/open_blows.hpp"

#include <algorithm>

#include "components/body_id.hpp"
#include "systems/bodies/blows.hpp"
#include "systems/bodies/thresholds.hpp"
#include "systems/models.hpp"

namespace cullet {
namespace {

ImpactEvent event_of(const Bodies& bodies, const Blows& blows, uint32_t row) {
    const Row<Bodies> body = blows.body[row];
    const Pose pose = pose_of(bodies, body);
    ImpactEvent e;
    e.body = body_id(bodies, body);
    e.body_user_data = bodies.user_data[body];
    e.place = to_world(pose, blows.point[row]);
    e.normal = rotate(pose.orientation, blows.direction[row]);
    e.approach_speed = blows.speed[row];
    const double speed = blows.speed[row], size = length(blows.impulse[row]);
    if (is_kind(blows, row, BlowKind::Push))
        e.energy = 0.5 * speed * speed / (double{blows.inverse_mass[row]} + 1 / bodies.mass[body]);
    else
        e.energy = 0.5 * size * size / bodies.mass[body];
    return e;
}

float radius_of(const WorldRows& state, const Blows& blows, uint32_t row, uint32_t t) {
    const Row<Structures> source = state.tasks.source[t];
    return calls_of(state.structures, source).patch_radius(state, source, blows.radius[row]);
}

// The task's contact in whose patch the push lies, or kNone. Vertices of two patches take one spring alone: a second
// push there would be lost.
uint32_t contact_at(const WorldRows& state, const Blows& blows, uint32_t row, uint32_t t) {
    const TaskContacts& contacts = state.task_contacts;
    const float radius = radius_of(state, blows, row, t);
    const uint32_t first = state.tasks.first_contact[t];
    for (uint32_t c = first; c < first + state.tasks.contact_count[t]; ++c)
        if (length(contacts.point[c] - blows.point[row]) < std::max(radius, contacts.radius[c])) return c;
    return kNone;
}

// Two that strike as one: bodies get their own impulse back, and what pushes another way another answer.
bool may_merge(const TaskContacts& contacts, const Blows& blows, uint32_t row, uint32_t c) {
    constexpr float kSameWay = 0.7f;  // cosine of 45 degrees
    return !contacts.striker[c].exists() && contacts.striker_inverse_mass[c] > 0 &&
           dot(contacts.normal[c], blows.direction[row]) > kSameWay;
}

// Whether a task of this step, or one that is to be opened, can take the blow too.
bool fits(const WorldRows& state, const Blows& blows, uint32_t row, uint32_t t, bool is_late) {
    const bool is_cut = is_kind(blows, row, BlowKind::Cut);
    if (is_cut != is_cut_task(blows, Row<Tasks>(t))) return false;
    if (!is_late && !is_cut && blows.is_paid[row]) return false;  // or the run would give it a second time
    if (!is_kind(blows, row, BlowKind::Push)) return true;
    const uint32_t at = contact_at(state, blows, row, t);
    return at == kNone ? state.tasks.contact_count[t] < kMostContacts : may_merge(state.task_contacts, blows, row, at);
}

Vec3 moving_at(const BodyRows& state, uint32_t t, Vec3 point) {
    const Vec3 arm = point - state.bodies.centre[state.tasks.body[t]].to_float();
    return state.tasks.start_velocity[t] + cross(state.tasks.start_spin[t], arm);
}

// Masses add; speed, way and place are the mean by momentum: what sticks together and goes on as one.
void merge_push(WorldRows& state, const Blows& blows, uint32_t row, uint32_t t, uint32_t c) {
    TaskContacts& contacts = state.task_contacts;
    const double mass = 1 / double{contacts.striker_inverse_mass[c]}, added = 1 / double{blows.inverse_mass[row]};
    const Vec3 point = contacts.point[c], normal = contacts.normal[c];
    const float speed_of_first = contacts.start_speed[c] - dot(moving_at(state, t, point), normal);
    const double before = mass * std::max(0.0, double{speed_of_first});
    const double gained = added * double{blows.speed[row]};
    const Vec3d momentum = before * Vec3d(normal) + gained * Vec3d(blows.direction[row]);
    const Vec3d place = (1 / (before + gained)) * (before * Vec3d(point) + gained * Vec3d(blows.point[row]));
    const auto speed = static_cast<float>(length(momentum) / (mass + added));
    contacts.point.set(c, place.to_float());
    contacts.normal.set(c, normalised(momentum).to_float());
    contacts.striker_inverse_mass[c] = static_cast<float>(1 / (mass + added));
    contacts.start_speed[c] = dot(moving_at(state, t, contacts.point[c]), contacts.normal[c]) + speed;
    if (gained > before) contacts.striker_radius[c] = blows.radius[row];
    contacts.radius[c] = std::max(contacts.radius[c], radius_of(state, blows, row, t));
}

void lay_push(WorldRows& state, const Blows& blows, uint32_t row, uint32_t t) {
    if (const uint32_t at = contact_at(state, blows, row, t); at != kNone) return merge_push(state, blows, row, t, at);
    Tasks& tasks = state.tasks;
    TaskContacts& contacts = state.task_contacts;
    const uint32_t c = tasks.first_contact[t] + tasks.contact_count[t]++;
    contacts.clear_rows(c, 1);
    contacts.point.set(c, blows.point[row]);
    contacts.normal.set(c, blows.direction[row]);
    contacts.striker[c] = {};
    contacts.striker_inverse_mass[c] = blows.inverse_mass[row];
    contacts.striker_radius[c] = blows.radius[row];
    contacts.start_speed[c] = dot(moving_at(state, t, blows.point[row]), blows.direction[row]) + blows.speed[row];
    contacts.radius[c] = radius_of(state, blows, row, t);
}

enum class Outcome : uint8_t { Waits, Joined, Gone };

struct Opener {
    BlowOpening& o;
    WorldRows& state = o.opening.state;
    Blows& blows = o.opening.blows;
    uint64_t cut_units = 0;  // of the cuts that this step makes

    uint64_t units_of_cut(uint32_t row) const {
        const Row<Structures> structure = state.bodies.structure[blows.body[row]];
        return calls_of(state.structures, structure).units_of_cut(state, structure, blows, row);
    }
    /// Step by step, as its body breaks.
    bool is_parted(uint32_t row) const { return is_kind(blows, row, BlowKind::Cut) && units_of_cut(row) == 0; }
    /// Cuts are made whole, in the step that opens their task: at least one, then as long as the frame's units last.
    bool may_cut(uint32_t row) {
        const uint64_t units = units_of_cut(row);
        if (units == 0) return true;
        if (cut_units > 0 && cut_units + units > o.settings.units_a_frame) return false;
        cut_units += units;
        return true;
    }

    // What sleeps may lose its support to a cut.
    void wake(Row<Bodies> body) {
        if (static_cast<BodyKind>(state.bodies.kind[body]) != BodyKind::Dynamic) return;
        o.rigid.wake(body);
        state.bodies.is_asleep[body] = 0;
    }
    void pay(uint32_t row) { pay_blow(blows, state.bodies, o.rigid, o.opening.counts, row); }

    void join(uint32_t row, uint32_t t) {
        Tasks& tasks = state.tasks;
        if (tasks.is_late[t]) pay(row);
        wake(tasks.body[t]);
        blows.task[row] = t;
        if (is_kind(blows, row, BlowKind::Cut)) return;
        if (is_kind(blows, row, BlowKind::Push))
            lay_push(state, blows, row, t);
        else
            state.hidden_runs.quiet_time[t] = state.hidden_runs.end_time[t];  // no touch tells when it is over
        tasks.approach_speed[t] = std::max(tasks.approach_speed[t], blows.speed[row]);
        o.impact_events.push(event_of(state.bodies, blows, row));
    }

    bool leaves_nothing(uint32_t row) const {
        Knock knock;
        knock.body = blows.body[row];
        knock.point = Vec3d(blows.point[row]), knock.push = Vec3d(blows.direction[row]);
        knock.speed = double{blows.speed[row]}, knock.striker_inverse_mass = double{blows.inverse_mass[row]};
        knock.radius = double{blows.radius[row]};
        knock.frame = o.opening.frame, knock.step_seconds = o.opening.dt;
        float bounce = 0;
        return o.opening.models.leaves_nothing(state, knock, bounce);
    }

    /// New ones that damage is not worth looking at for, or is forbidden for.
    bool is_harmless(uint32_t row) const {
        const Row<Bodies> body = blows.body[row];
        if (blows.speed[row] <=
            wake_speed(state.structures, state.bodies.structure[body], state.bodies.strength_scale[body]))
            return true;
        if (!may_break_again(state.structures, state.bodies.structure[body], o.settings)) return true;
        if (is_kind(blows, row, BlowKind::Push) && leaves_nothing(row)) return true;
        return o.settings.allows && !o.settings.allows(o.settings.allows_user, event_of(state.bodies, blows, row));
    }

    Outcome look_at(uint32_t row) {
        const Row<Bodies> body = blows.body[row];
        const bool is_cut = is_kind(blows, row, BlowKind::Cut), is_new = !blows.is_taken[row];
        blows.is_taken[row] = 1;
        if (!is_cut && is_new && is_harmless(row)) {
            pay(row);
            return Outcome::Gone;
        }
        if (!is_cut && !may_break_again(state.structures, state.bodies.structure[body], o.settings))
            return Outcome::Gone;
        const uint32_t open = state.bodies.task[body];
        if (open != kNone) {
            const bool is_fresh = state.tasks.opened_frame[open] == o.opening.frame;
            if (is_fresh && fits(state, blows, row, open, state.tasks.is_late[open]) && (!is_cut || may_cut(row))) {
                join(row, open);
                return Outcome::Joined;
            }
        } else if (!state.bodies.hold_count[body] && o.opening.frame >= state.bodies.retry_frame[body] &&
                   has_free_task(state.tasks) && (!is_cut || may_cut(row)) &&
                   !(is_parted(row) && o.opening.models.is_full(state, body))) {
            const Row<Tasks> task = o.opening.open(body, is_cut ? 1.0f : blows.speed[row]);
            if (!task.exists()) {
                pay(row);
                return o.opening.models.may_find_room(state, body) ? Outcome::Waits : Outcome::Gone;
            }
            // What presses on it does not wait until it is parted.
            state.tasks.is_late[task] = is_parted(row) || (!is_cut && blows.is_paid[row]);
            join(row, task);
            return Outcome::Joined;
        }
        pay(row);
        return Outcome::Waits;
    }
};

}  // namespace

bool has_free_task(const Tasks& tasks) {
    for (uint32_t t = 0; t < tasks.size(); ++t)
        if (static_cast<TaskState>(tasks.state[t]) == TaskState::Free) return true;
    return false;
}

void open_blows(BlowOpening& opening) {
    Blows& blows = opening.opening.blows;
    Opener opener{opening};
    for (uint32_t row = 0; row < blows.size();) {
        if (blows.task[row] == kNone && opener.look_at(row) == Outcome::Gone)
            remove_blow(blows, row);
        else
            ++row;
    }
}

}  // namespace cullet
