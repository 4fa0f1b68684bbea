#include <algorithm>

#include "systems/brittle/hidden_region.hpp"
#include "systems/damage/assemble.hpp"
#include "systems/damage/blows.hpp"
#include "systems/damage/open_blows.hpp"
#include "systems/damage/struck_normal.hpp"
#include "systems/damage/task_cost.hpp"
#include "systems/damage/thresholds.hpp"
#include "systems/damage/working_room.hpp"
#include "systems/quick/cut_out.hpp"
#include "systems/rigid/body_id.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

// How a body yields to pushes along the unit normal at a world point.
struct Yielding {
    double own = 0;  // 1/m, 1/kg
    Vec3d turn;      // r x n about its centre, its axes, m
    Vec3d spin;      // I^-1 (r x n), its axes, 1/(kg m)
    float effective() const { return static_cast<float>(own + dot(turn, spin)); }
};

// What pushes a ball without friction points at its centre. Static and kinematic bodies, and bodies held by another
// task, do not yield.
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

Vec3 velocity_at(const Bodies& bodies, Row<Bodies> b, Vec3 point) {
    if (!b.exists()) return {};
    const Vec3 centre = to_world(pose_of(bodies, b), bodies.centre[b].to_float());
    return bodies.velocity[b] + cross(bodies.spin[b], point - centre);
}

float patch_radius(const Shells& shells, Row<Shells> shell, float striker_radius) {
    return std::max({3 * shells.thickness[shell], 1.3f * shells.mean_edge[shell], 0.35f * striker_radius});
}

// A blow as the task will have it: a ball's goes along the struck surface's normal, unless it does not close along
// that.
Impact aimed(State& state, Impact impact) {
    const Bodies& bodies = state.bodies;
    const Row<Bodies> striker = impact.striker;
    if (!striker.exists() || !bodies.is_sphere[striker]) return impact;
    const Row<Shells> shell = bodies.shell[impact.body];
    const Pose pose = pose_of(bodies, impact.body);
    const Vec3 normal =
        rotate(pose.orientation, struck_normal(ShellView(state, shell), to_body(pose, impact.point),
                                               rotate(conjugate(pose.orientation), impact.normal),
                                               patch_radius(state.shells, shell, bodies.radius[striker])));
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

// Contacts of one body, fastest first: those within a patch radius of one already taken belong to its patch (6.3).
// `first_aimed` is the first of them as aimed() has it.
void lay_contacts(std::span<const Impact> impacts, const Impact& first_aimed, State& state, Row<Tasks> task) {
    const Bodies& bodies = state.bodies;
    const Shells& shells = state.shells;
    Tasks& tasks = state.tasks;
    TaskContacts& contacts = state.task_contacts;
    const Row<Bodies> body = tasks.body[task];
    const Row<Shells> shell = tasks.source[task];
    const Pose pose = pose_of(bodies, body);
    uint32_t count = 0;
    for (const Impact& told : impacts) {
        if (count == kMostContacts) break;
        const Vec3 point = to_body(pose, told.point);
        const float striker_radius =
            told.striker.exists() && bodies.is_sphere[told.striker] ? bodies.radius[told.striker] : 0.0f;
        const float radius = patch_radius(shells, shell, striker_radius);
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

struct Opening {
    State& state;
    Events<TaskOpened>& opened;
    Events<StiffnessWanted>& stiffness_wanted;
    Events<RefusedEvent>& refused;
    DamageCounts& counts;
    uint64_t frame;

    // A task with a working copy of the body's shell and no contacts yet; it does not exist where there is no room. A
    // cut-out waits for the contacts.
    Row<Tasks> open(Row<Bodies> body, float approach_speed) {
        Tasks& tasks = state.tasks;
        Bodies& bodies = state.bodies;
        uint32_t t = 0;
        while (t < tasks.size() && static_cast<TaskState>(tasks.state[t]) != TaskState::Free) ++t;
        if (t == tasks.size()) {
            refused.push(refused_event(bodies, body, "limits.open_hits"));
            return {};
        }
        const char* full = nullptr;
        const Row<Shells> source = bodies.shell[body];
        const bool is_quick = is_quick_body(state, body);
        const ShellView before(state, source);
        const bool waits = may_cut_out(state, body);
        Row<Shells> working;
        if (!waits) working = make_shell_unclear(state, is_quick ? quick_room(before) : working_room(before), &full);
        if (!waits && !working.exists()) {
            refused.push(refused_event(bodies, body, full));
            return {};
        }
        const Row<Tasks> task(t);
        tasks.clear_rows(t, 1);
        tasks.state[t] = static_cast<uint8_t>(TaskState::Running);
        tasks.body[t] = body;
        tasks.source[t] = source;
        ++state.shells.users[source];
        tasks.shell[t] = working;
        tasks.opened_frame[t] = frame;
        tasks.first_contact[t] = t * kMostContacts;
        tasks.approach_speed[t] = approach_speed;
        const Quat to_body_axes = conjugate(bodies.orientation[body]);
        tasks.start_velocity.set(t, rotate(to_body_axes, bodies.velocity[body]));
        tasks.start_spin.set(t, rotate(to_body_axes, bodies.spin[body]));
        tasks.strength_scale[t] = bodies.strength_scale[body];
        set_task_times(state, task);
        set_quick_task(state, task, body);
        const bool is_assembled = is_quick || waits || state.shells.packs[source].count > 0;
        const uint64_t units = is_quick ? kUnitsQuickCopy : kUnitsOpen + (is_assembled ? 0 : kUnitsAssemble);
        if (!waits) tasks.units_owed[t] = state.shells.vertices[source].count * units;
        bodies.task[body] = t;
        opened.push({task});
        const uint32_t packs = is_assembled ? 0 : (state.shells.vertices[source].count + kLanes - 1) / kLanes;
        for (uint32_t p = 0; p < packs; p += kRowsPerChunk<StiffnessPacks>) stiffness_wanted.push({task, p});
        ++counts.opened;
        return task;
    }

    // Rows for the tasks that wait: of the neighbourhood of their contacts, or of the whole body where blows reach it
    // all, or the hit is wide. A task that finds none is dropped.
    void give_rows() {
        Tasks& tasks = state.tasks;
        for (const TaskOpened& o : opened) {
            if (tasks.shell[o.task].exists()) continue;
            const char* full = nullptr;
            const ShellView source(state, tasks.source[o.task]);
            CutOutResult result = CutOutResult::TooWide;
            const bool is_everywhere = has_explosion(state.blows, o.task) || is_cut_task(state.blows, o.task);
            if (!is_quick_task(state, o.task)) {
                const uint32_t wanted = is_everywhere ? kNone : kWholeCopyVertices;
                if (!give_hidden_rows(state, o.task, wanted, stiffness_wanted, &full)) {
                    tasks.state[o.task] = static_cast<uint8_t>(TaskState::Dropped);
                    refused.push(refused_event(state.bodies, tasks.body[o.task], full));
                }
                continue;
            }
            if (!is_everywhere) result = reserve_cut_out(state, o.task, quick_cut_out_size(state, o.task), &full);
            if (result == CutOutResult::TooWide)
                tasks.shell[o.task] = make_shell_unclear(state, quick_room(source), &full);
            const Row<Shells> working = tasks.shell[o.task];
            if (working.exists()) {
                tasks.units_owed[o.task] += result == CutOutResult::Reserved
                                                ? state.shells.vertices[working].count * kUnitsQuickOpen
                                                : source.vertex_count() * kUnitsQuickCopy;
            } else {
                tasks.state[o.task] = static_cast<uint8_t>(TaskState::Dropped);
                refused.push(refused_event(state.bodies, tasks.body[o.task], full));
            }
        }
    }
};

// The fastest of each striker's contacts; a faster one takes the place of what the same striker did before.
void queue_hits(std::span<const Impact> impacts, State& state, uint64_t frame, Events<RefusedEvent>& refused) {
    const Bodies& bodies = state.bodies;
    QueuedHits& queued = state.queued_hits;
    for (const Impact& told : impacts) {
        const Impact impact = aimed(state, told);
        uint32_t free = kNone, found = kNone;
        for (uint32_t q = 0; q < queued.size(); ++q) {
            if (!queued.is_used[q])
                free = std::min(free, q);
            else if (queued.body[q] == impact.body && queued.striker[q] == impact.striker)
                found = q;
        }
        if (found != kNone && queued.approach_speed[found] >= impact.approach_speed) continue;
        const uint32_t q = found != kNone ? found : free;
        if (q == kNone) {
            refused.push(refused_event(bodies, impact.body, "limits.queued_hits"));
            return;
        }
        const Pose pose = pose_of(bodies, impact.body);
        queued.is_used[q] = 1;
        queued.frame[q] = frame;
        queued.body[q] = impact.body;
        queued.striker[q] = impact.striker;
        queued.point.set(q, to_body(pose, impact.point));
        queued.normal.set(q, rotate(conjugate(pose.orientation), impact.normal));
        queued.approach_speed[q] = impact.approach_speed;
        queued.striker_inverse_mass[q] = yielding_of(bodies, impact.striker, impact.point, impact.normal).effective();
        queued.striker_radius[q] =
            impact.striker.exists() && bodies.is_sphere[impact.striker] ? bodies.radius[impact.striker] : 0.0f;
    }
}

// The contact as it was: striker and body meet at the speed that they had relative to each other then. Something that
// does not yield must stand still, or it would do work on the body: then the body is given the speed. A late result
// uses velocities relative to the body's mean alone, so either is as good.
void lay_queued(State& state, Row<Tasks> task, uint32_t q) {
    Tasks& tasks = state.tasks;
    TaskContacts& contacts = state.task_contacts;
    const QueuedHits& queued = state.queued_hits;
    const Row<Shells> shell = tasks.source[task];
    const uint32_t c = tasks.first_contact[task];
    const Vec3 arm = queued.point[q] - state.bodies.centre[tasks.body[task]].to_float();
    const Vec3 moving = tasks.start_velocity[task] + cross(tasks.start_spin[task], arm);
    contacts.clear_rows(c, 1);
    contacts.point.set(c, queued.point[q]);
    contacts.normal.set(c, queued.normal[q]);
    contacts.striker[c] = queued.striker[q];
    contacts.striker_inverse_mass[c] = queued.striker_inverse_mass[q];
    contacts.striker_radius[c] = queued.striker_radius[q];
    const float along = dot(moving, queued.normal[q]) + queued.approach_speed[q];
    if (queued.striker_inverse_mass[q] > 0)
        contacts.start_speed[c] = along;
    else
        tasks.start_velocity.set(task, tasks.start_velocity[task] - along * queued.normal[q]);
    contacts.radius[c] = patch_radius(state.shells, shell, queued.striker_radius[q]);
    tasks.contact_count[task] = 1;
    tasks.is_late[task] = 1;
}

// A hit that settle_tasks will hold: a bump below the first-crack speed is late, and the solver's affair, at once.
bool will_be_held(const State& state, const DamageSettings& settings, Row<Tasks> task) {
    const Tasks& tasks = state.tasks;
    return static_cast<TaskState>(tasks.state[task]) == TaskState::Running && !tasks.is_late[task] &&
           settings.hold_seconds > 0 &&
           tasks.approach_speed[task] > first_crack_speed(state.shells, tasks.source[task], tasks.strength_scale[task]);
}

// A striker that touches k bodies whose tasks open in one frame is given to each as k times as light: k strikers of a
// k-th of its mass each lose together at most what one loses that all k push, by the convexity of |v|^2. Else each
// task would take its own from the whole of its motion, and breaks would add energy.
void share_strikers(State& state, const DamageSettings& settings, std::span<const TaskOpened> opened) {
    const Tasks& tasks = state.tasks;
    TaskContacts& contacts = state.task_contacts;
    const auto takes = [&](Row<Tasks> task, Row<Bodies> striker) {
        const uint32_t first = tasks.first_contact[task], end = first + tasks.contact_count[task];
        for (uint32_t c = first; c < end; ++c)
            if (contacts.striker[c] == striker && contacts.striker_own_inverse_mass[c] > 0)
                return will_be_held(state, settings, task);
        return false;
    };
    const auto for_each_shared = [&](auto visit) {
        for (const TaskOpened& of : opened) {
            if (!will_be_held(state, settings, of.task)) continue;
            const uint32_t first = tasks.first_contact[of.task], end = first + tasks.contact_count[of.task];
            for (uint32_t c = first; c < end; ++c)
                if (contacts.striker[c].exists() && contacts.striker_own_inverse_mass[c] > 0) visit(c);
        }
    };
    for_each_shared([&](uint32_t c) {
        uint32_t sharers = 0;
        for (const TaskOpened& other : opened) sharers += takes(other.task, contacts.striker[c]);
        contacts.sharers[c] = sharers > 1 ? static_cast<uint8_t>(std::min(sharers, 255u)) : uint8_t{0};
    });
    for_each_shared([&](uint32_t c) {
        if (contacts.sharers[c] == 0) return;
        const float share = contacts.sharers[c];
        contacts.striker_inverse_mass[c] *= share;
        contacts.striker_own_inverse_mass[c] *= share;
        contacts.striker_spin.set(c, share * contacts.striker_spin[c]);
    });
}

// The least of the queue's frames from this one on, or the largest number there is.
uint64_t next_queued_frame(const QueuedHits& queued, uint64_t from) {
    uint64_t least = ~uint64_t{0};
    for (uint32_t q = 0; q < queued.size(); ++q)
        if (queued.is_used[q] && queued.frame[q] >= from) least = std::min(least, queued.frame[q]);
    return least;
}

// Those of one frame in the order of the queue's rows, one a body and frame, while tasks last: the others wait.
void open_queued_of(uint64_t frame, Opening& opening, const DamageSettings& settings,
                    Events<ImpactEvent>& impact_events) {
    State& state = opening.state;
    const Bodies& bodies = state.bodies;
    QueuedHits& queued = state.queued_hits;
    for (uint32_t q = 0; q < queued.size() && has_free_task(state.tasks); ++q) {
        if (!queued.is_used[q] || queued.frame[q] != frame) continue;
        const Row<Bodies> body = queued.body[q];
        if (bodies.task[body] != kNone || opening.frame < bodies.retry_frame[body] || bodies.hold_count[body]) continue;
        if (may_break_again(state.shells, bodies.shell[body], settings)) {
            const Row<Tasks> task = opening.open(body, queued.approach_speed[q]);
            if (task.exists()) {
                lay_queued(state, task, q);
                const Pose pose = pose_of(bodies, body);
                const Impact impact{body, queued.striker[q], to_world(pose, queued.point[q]),
                                    rotate(pose.orientation, queued.normal[q]), queued.approach_speed[q]};
                impact_events.push(event_of(bodies, impact, queued.striker_inverse_mass[q]));
            }
        }
        queued.clear_rows(q, 1);
    }
}

// Oldest first.
void open_queued(Opening& opening, const DamageSettings& settings, Events<ImpactEvent>& impact_events) {
    const QueuedHits& queued = opening.state.queued_hits;
    for (uint64_t frame = next_queued_frame(queued, 0); frame < opening.frame && has_free_task(opening.state.tasks);
         frame = next_queued_frame(queued, frame + 1))
        open_queued_of(frame, opening, settings, impact_events);
}

}  // namespace

void open_tasks(Serial, Step step, const Events<Impact>& impacts, ShellTables shells, const Materials&, Bodies& bodies,
                Tasks&, TaskContacts&, QueuedHits&, Blows&, RigidWorld& rigid, const DamageSettings& settings,
                DamageCounts& counts, Events<TaskOpened>& opened, Events<StiffnessWanted>& stiffness_wanted,
                Events<ImpactEvent>& impact_events, Events<RefusedEvent>& refused) {
    State& state = shells.state;
    opened.clear();
    stiffness_wanted.clear();
    Opening opening{state, opened, stiffness_wanted, refused, counts, step.frame};
    open_queued(opening, settings, impact_events);
    const auto all = impacts.all();
    for (size_t i = 0, next; i < all.size(); i = next) {
        next = i + 1;
        while (next < all.size() && all[next].body == all[i].body) ++next;
        const Row<Bodies> body = all[i].body;
        const Impact first = aimed(state, all[i]);
        const ImpactEvent event =
            event_of(bodies, first, yielding_of(bodies, first.striker, first.point, first.normal).effective());
        if (settings.allows && !settings.allows(settings.allows_user, event)) continue;
        if (bodies.task[body] != kNone || !has_free_task(state.tasks)) {
            queue_hits(all.subspan(i, next - i), state, step.frame, refused);
            continue;
        }
        const Row<Tasks> task = opening.open(body, first.approach_speed);
        if (!task.exists()) continue;
        lay_contacts(all.subspan(i, next - i), first, state, task);
        impact_events.push(event);
    }
    BlowOpening blows{
        state,
        rigid,
        settings,
        counts,
        impact_events,
        step.frame,
        &opening,
        [](void* opener, Row<Bodies> body, float speed) { return static_cast<Opening*>(opener)->open(body, speed); }};
    open_blows(blows);
    opening.give_rows();
    share_strikers(state, settings, opened.all());
}

}  // namespace cullet
