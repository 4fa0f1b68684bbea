#include "systems/impacts/opening.hpp"

#include <algorithm>

#include "components/body_id.hpp"
#include "systems/bodies/blows.hpp"
#include "systems/bodies/thresholds.hpp"
#include "systems/models.hpp"

namespace cullet {
namespace {

Vec3 velocity_at(const Bodies& bodies, Row<Bodies> b, Vec3 point) {
    if (!b.exists()) return {};
    const Vec3 centre = to_world(pose_of(bodies, b), bodies.centre[b].to_float());
    return bodies.velocity[b] + cross(bodies.spin[b], point - centre);
}

// Of two that one striker owes a body the faster is enough. A snap goes before all: what closes slowly on a cracked
// body strikes it anew in each frame, without breaking it.
bool goes_before(float load, float speed, float load_of_other, float speed_of_other) {
    if (is_snap(load_of_other, speed_of_other)) return false;
    return is_snap(load, speed) || speed > speed_of_other;
}

}  // namespace

Yielding yielding_of(const Bodies& bodies, Row<Bodies> striker, Vec3 point, Vec3 normal) {
    if (!striker.exists() || static_cast<BodyKind>(bodies.kind[striker]) != BodyKind::Dynamic) return {};
    if (bodies.hold_count[striker]) return {};
    const double own = 1.0 / bodies.mass[striker];
    if (bodies.is_sphere[striker]) return {own, {}, {}};
    const Vec3d n(rotate(conjugate(bodies.orientation[striker]), normal));
    const Vec3d arm = Vec3d(to_body(pose_of(bodies, striker), point)) - bodies.centre[striker];
    const Vec3d turn = cross(arm, n);
    return {own, turn, inverse(bodies.inertia[striker]) * turn};
}

Impact aimed(WorldRows& state, Impact impact) {
    const Bodies& bodies = state.bodies;
    const Row<Bodies> striker = impact.striker;
    if (!striker.exists() || !bodies.is_sphere[striker]) return impact;
    const Row<Structures> structure = bodies.structure[impact.body];
    const Pose pose = pose_of(bodies, impact.body);
    const Vec3 normal = rotate(pose.orientation, calls_of(state.structures, structure)
                                                     .struck_normal(state, structure, to_body(pose, impact.point),
                                                                    rotate(conjugate(pose.orientation), impact.normal),
                                                                    bodies.radius[striker]));
    const Vec3 closing = bodies.velocity[striker] - velocity_at(bodies, impact.body, impact.point);
    if (!(dot(closing, normal) > 0)) return impact;
    impact.normal = normal;
    impact.approach_speed = dot(closing, normal);
    return impact;
}

ImpactEvent event_of(const Bodies& bodies, const Impact& impact, double inverse_mass) {
    ImpactEvent e;
    e.body = body_id(bodies, impact.body);
    e.striker = body_id(bodies, impact.striker);
    e.body_user_data = bodies.user_data[impact.body];
    e.striker_user_data = impact.striker.exists() ? bodies.user_data[impact.striker] : 0;
    e.place = impact.point;
    e.normal = impact.normal;
    e.approach_speed = impact.approach_speed;
    const double speed = impact.approach_speed;
    e.energy = 0.5 * speed * speed / (inverse_mass + 1.0 / bodies.mass[impact.body]);
    return e;
}

void lay_contacts(std::span<const Impact> impacts, const Impact& first_aimed, WorldRows& state, Row<Tasks> task) {
    const Bodies& bodies = state.bodies;
    Tasks& tasks = state.tasks;
    TaskContacts& contacts = state.task_contacts;
    const Row<Bodies> body = tasks.body[task];
    const StructureCalls& calls = calls_of(state.structures, tasks.source[task]);
    const Pose pose = pose_of(bodies, body);
    uint32_t count = 0;
    for (const Impact& told : impacts) {
        if (count == kMostContacts) break;
        const Vec3 point = to_body(pose, told.point);
        const float striker_radius =
            told.striker.exists() && bodies.is_sphere[told.striker] ? bodies.radius[told.striker] : 0.0f;
        const float radius = calls.patch_radius(state, tasks.source[task], striker_radius);
        const uint32_t first = tasks.first_contact[task];
        const auto is_taken = [&](uint32_t c) { return length(contacts.point[c] - point) < radius; };
        bool joins = false;
        for (uint32_t c = first; c < first + count; ++c) joins = joins || is_taken(c);
        if (joins) continue;
        const Impact impact = &told == impacts.data() ? first_aimed : aimed(state, told);
        const uint32_t c = first + count++;
        contacts.clear_rows(c, 1);
        contacts.point.set(c, point);
        contacts.normal.set(c, rotate(conjugate(pose.orientation), impact.normal));
        contacts.striker[c] = impact.striker;
        contacts.cell[c] = told.cell;
        contacts.approach_speed[c] = told.approach_speed;
        const Yielding yielding = yielding_of(bodies, impact.striker, impact.point, impact.normal);
        contacts.striker_inverse_mass[c] = yielding.effective();
        if (yielding.own > 0) {
            const auto in_body_axes = [&](Vec3d of_striker) {
                return rotate(conjugate(pose.orientation),
                              rotate(bodies.orientation[impact.striker], of_striker.to_float()));
            };
            contacts.striker_own_inverse_mass[c] = static_cast<float>(yielding.own);
            contacts.striker_turn.set(c, in_body_axes(yielding.turn));
            contacts.striker_spin.set(c, in_body_axes(yielding.spin));
        }
        contacts.striker_radius[c] = striker_radius;
        contacts.start_speed[c] = dot(
            striker_radius > 0 ? bodies.velocity[impact.striker] : velocity_at(bodies, impact.striker, impact.point),
            impact.normal);
        contacts.radius[c] = radius;
    }
    tasks.contact_count[task] = count;
}

Row<Tasks> Opening::open(Row<Bodies> body, float approach_speed, bool is_ahead) {
    Tasks& tasks = state.tasks;
    Bodies& bodies = state.bodies;
    // A hit makes pieces that wait go with their body: not before it is sure to come.
    if (is_ahead && bodies.is_owed_births[body]) return {};
    uint32_t t = 0;
    while (t < tasks.size() && static_cast<TaskState>(tasks.state[t]) != TaskState::Free) ++t;
    if (t == tasks.size()) {
        refuse(body, "limits.open_hits", is_ahead);
        return {};
    }
    const Row<Structures> source = bodies.structure[body];
    const WorkingCopy working = models.working_copy(state, body);
    if (!working.waits && !working.structure.exists()) {
        refuse(body, working.full, is_ahead);
        if (!is_ahead) bodies.retry_frame[body] = frame + retry_frames(dt);
        return {};
    }
    const Row<Tasks> task(t);
    tasks.clear_rows(t, 1);
    state.hidden_runs.clear_rows(t, 1);
    tasks.state[t] = static_cast<uint8_t>(TaskState::Running);
    tasks.body[t] = body;
    tasks.source[t] = source;
    ++state.structures.users[source];
    tasks.working[t] = working.structure;
    tasks.opened_frame[t] = frame;
    tasks.first_contact[t] = t * kMostContacts;
    tasks.approach_speed[t] = approach_speed;
    const Quat to_body_axes = conjugate(bodies.orientation[body]);
    tasks.start_velocity.set(t, rotate(to_body_axes, bodies.velocity[body]));
    tasks.start_spin.set(t, rotate(to_body_axes, bodies.spin[body]));
    tasks.strength_scale[t] = bodies.strength_scale[body];
    tasks.strength_seed[t] = bodies.model_mesh[body].exists() ? bodies.strength_seed[body] : 0;
    if (bodies.is_owed_births[body]) calls_of(state.structures, source).forget_waiting(state, source);
    models.begin_run(state, task);
    bodies.task[body] = t;
    opened.push({task, state.model_of(task)});
    counts.opened += !is_ahead;
    return task;
}

bool Opening::leaves_nothing(const Impact& impact, uint64_t at, float& bounce) const {
    const Bodies& bodies = state.bodies;
    const Pose pose = pose_of(bodies, impact.body);
    Knock knock;
    knock.body = impact.body, knock.striker = impact.striker;
    knock.point = Vec3d(to_body(pose, impact.point));
    knock.push = Vec3d(rotate(conjugate(pose.orientation), impact.normal));
    knock.speed = double{impact.approach_speed};
    knock.striker_inverse_mass = double{yielding_of(bodies, impact.striker, impact.point, impact.normal).effective()};
    if (impact.striker.exists() && bodies.is_sphere[impact.striker])
        knock.radius = double{bodies.radius[impact.striker]};
    knock.frame = at, knock.step_seconds = dt;
    knock.is_sure = at == frame;
    return models.leaves_nothing(state, knock, bounce);
}

void Opening::give_rows() {
    const Tasks& tasks = state.tasks;
    for (const TaskOpened& o : opened) {
        if (tasks.working[o.task].exists()) continue;
        const char* full = nullptr;
        if (!models.give_late(state, blows, o.task, &full)) drop(o.task, full);
    }
}

// Pushes and strikers that were removed stand in contacts without one, which may be several at once: a blow waits as it
// is (close_blows), the others are lost.
void Opening::drop(Row<Tasks> task, const char* full) {
    Tasks& tasks = state.tasks;
    const TaskContacts& contacts = state.task_contacts;
    const Row<Bodies> body = tasks.body[task];
    tasks.state[task] = static_cast<uint8_t>(TaskState::Dropped);
    if (is_ahead(tasks, task)) return;
    refuse(body, full, false);
    if (!models.may_find_room(state, body)) return;
    for (uint32_t b = 0; b < blows.size(); ++b)
        if (blows.task[b] == task.index) blows.goes_on[b] = 1;
    const uint32_t first = tasks.first_contact[task];
    for (uint32_t c = first; c < first + tasks.contact_count[task]; ++c) {
        if (!contacts.striker[c].exists() && contacts.striker_inverse_mass[c] > 0) continue;
        const Vec3 arm = contacts.point[c] - state.bodies.centre[body].to_float();
        const Vec3 moving = tasks.start_velocity[task] + cross(tasks.start_spin[task], arm);
        const float approach = contacts.start_speed[c] - dot(moving, contacts.normal[c]);
        const bool is_queued =
            queue_hit(queued, {frame, body, contacts.striker[c], contacts.point[c], contacts.normal[c], approach,
                               contacts.striker_inverse_mass[c], contacts.striker_radius[c], tasks.load[task]});
        if (!is_queued) return refuse(body, "limits.queued_hits", false);
    }
}

bool queue_hit(QueuedHits& queued, const QueuedHit& hit) {
    uint32_t free = kNone, found = kNone;
    for (uint32_t q = 0; q < queued.size(); ++q) {
        if (!queued.is_used[q])
            free = std::min(free, q);
        else if (queued.body[q] == hit.body && queued.striker[q] == hit.striker)
            found = q;
    }
    if (found != kNone && !goes_before(hit.load, hit.approach_speed, queued.load[found], queued.approach_speed[found]))
        return true;
    const uint32_t q = found != kNone ? found : free;
    if (q == kNone) return false;
    queued.is_used[q] = 1;
    queued.frame[q] = hit.frame;
    queued.body[q] = hit.body;
    queued.striker[q] = hit.striker;
    queued.point.set(q, hit.point);
    queued.normal.set(q, hit.normal);
    queued.approach_speed[q] = hit.approach_speed;
    queued.striker_inverse_mass[q] = hit.striker_inverse_mass;
    queued.striker_radius[q] = hit.striker_radius;
    queued.load[q] = hit.load;
    return true;
}

bool has_waiting_load(const QueuedHits& queued, Row<Bodies> body) {
    for (uint32_t q = 0; q < queued.size(); ++q)
        if (queued.is_used[q] && queued.body[q] == body && queued.load[q] > 0) return true;
    return false;
}

void Opening::refuse(Row<Bodies> body, const char* setting, bool is_ahead) {
    if (!is_ahead) refused.push(refused_event(state.bodies, body, setting));
}

}  // namespace cullet
