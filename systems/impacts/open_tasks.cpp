#include <algorithm>

#include "components/body_id.hpp"
#include "systems/bodies/blows.hpp"
#include "systems/bodies/cut_by_load.hpp"
#include "systems/bodies/thresholds.hpp"
#include "systems/impacts/open_ahead.hpp"
#include "systems/impacts/open_blows.hpp"
#include "systems/impacts/opening.hpp"
#include "systems/models.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

// The fastest of each striker's contacts; a faster one takes the place of what the same striker did before.
void queue_hits(std::span<const Impact> impacts, Opening& opening) {
    auto& state = opening.state;
    const Bodies& bodies = state.bodies;
    for (const Impact& told : impacts) {
        const Impact impact = aimed(state, told);
        const Pose pose = pose_of(bodies, impact.body);
        const Row<Bodies> striker = impact.striker;
        const bool is_queued =
            queue_hit(opening.queued, {opening.frame, impact.body, striker, to_body(pose, impact.point),
                                       rotate(conjugate(pose.orientation), impact.normal), impact.approach_speed,
                                       yielding_of(bodies, striker, impact.point, impact.normal).effective(),
                                       striker.exists() && bodies.is_sphere[striker] ? bodies.radius[striker] : 0.0f});
        if (!is_queued) return (void)opening.refused.push(refused_event(bodies, impact.body, "limits.queued_hits"));
    }
}

// The contact as it was: striker and body meet at the speed that they had relative to each other then. Something that
// does not yield must stand still, or it would do work on the body: then the body is given the speed. A late result
// uses velocities relative to the body's mean alone, so either is as good.
void lay_queued(WorldRows& state, const QueuedHits& queued, Row<Tasks> task, uint32_t q) {
    Tasks& tasks = state.tasks;
    TaskContacts& contacts = state.task_contacts;
    const Row<Structures> structure = tasks.source[task];
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
    contacts.radius[c] = calls_of(state.structures, structure).patch_radius(state, structure, queued.striker_radius[q]);
    tasks.contact_count[task] = 1;
    tasks.is_late[task] = 1;
    tasks.load[task] = queued.load[q];
}

// A hit that settle_tasks will hold: a bump below the first-crack speed is late, and the solver's affair, at once.
bool will_be_held(const RunRows& state, const DamageRules& rules, Row<Tasks> task) {
    const Tasks& tasks = state.tasks;
    return static_cast<TaskState>(tasks.state[task]) == TaskState::Running && !tasks.is_late[task] &&
           is_worth_a_hold(state.structures, tasks, task, rules.settings,
                           rules.models.breaks_at_any_speed(state.structures, tasks.source[task]));
}

// A striker that touches k bodies whose tasks open in one frame is given to each as k times as light: k strikers of a
// k-th of its mass each lose together at most what one loses that all k push, by the convexity of |v|^2. Else each
// task would take its own from the whole of its motion, and breaks would add energy.
void share_strikers(SoftRows& state, const DamageRules& rules, std::span<const TaskOpened> opened) {
    const Tasks& tasks = state.tasks;
    TaskContacts& contacts = state.task_contacts;
    const auto takes = [&](Row<Tasks> task, Row<Bodies> striker) {
        const uint32_t first = tasks.first_contact[task], end = first + tasks.contact_count[task];
        for (uint32_t c = first; c < end; ++c)
            if (contacts.striker[c] == striker && contacts.striker_own_inverse_mass[c] > 0)
                return will_be_held(state, rules, task);
        return false;
    };
    const auto for_each_shared = [&](auto visit) {
        for (const TaskOpened& of : opened) {
            if (!will_be_held(state, rules, of.task)) continue;
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

// All impacts of a body are such that its damage model passes them over: they bounce, no more. Each striker's fastest
// is looked at.
bool leave_nothing(const Opening& opening, std::span<const Impact> impacts, RigidWorld& rigid) {
    bool is_nothing = true;
    for (size_t i = 0; i < impacts.size(); ++i) {
        const auto is_his = [&](const Impact& before) { return before.striker == impacts[i].striker; };
        if (std::any_of(impacts.begin(), impacts.begin() + static_cast<ptrdiff_t>(i), is_his)) continue;
        float bounce = 0;
        if (!opening.leaves_nothing(aimed(opening.state, impacts[i]), opening.frame, bounce))
            is_nothing = false;
        else if (bounce > 0 && impacts[i].striker.exists())
            rigid.set_bounce(impacts[i].body, impacts[i].striker, bounce);
    }
    return is_nothing;
}

// The least of the queue's frames from this one on, or the largest number there is.
uint64_t next_queued_frame(const QueuedHits& queued, uint64_t from) {
    uint64_t least = ~uint64_t{0};
    for (uint32_t q = 0; q < queued.size(); ++q)
        if (queued.is_used[q] && queued.frame[q] >= from) least = std::min(least, queued.frame[q]);
    return least;
}

// A load that is no blow: the cut that it asks for is opened with the other blows of this step. False: it waits.
bool open_snap(Opening& opening, uint32_t q, Events<ImpactEvent>& impact_events) {
    auto& state = opening.state;
    const QueuedHits& queued = opening.queued;
    const Row<Bodies> body = queued.body[q];
    const uint64_t seed = queued.frame[q] * 0x10001 + body.index;
    const StructureCalls& calls = calls_of(state.structures, state.bodies.structure[body]);
    if (!calls.part_by_load(state, opening.blows, body, {queued.point[q], queued.normal[q], seed})) return false;
    const Pose pose = pose_of(state.bodies, body);
    ImpactEvent event = event_of(
        state.bodies,
        {body, queued.striker[q], to_world(pose, queued.point[q]), rotate(pose.orientation, queued.normal[q]), 0},
        queued.striker_inverse_mass[q]);
    event.load = queued.load[q];
    impact_events.push(event);
    return true;
}

// A hit that found no rows in so long finds none: models and other bodies keep them. Later nobody would know what it
// was that broke.
constexpr float kMostSecondsQueued = 2;

// Those of one frame in the order of the queue's rows, one a body and frame, while tasks last: the others wait, and so
// does what finds no rows now but may find some soon.
void open_queued_of(uint64_t frame, Opening& opening, const DamageSettings& settings,
                    Events<ImpactEvent>& impact_events) {
    auto& state = opening.state;
    const Bodies& bodies = state.bodies;
    QueuedHits& queued = opening.queued;
    for (uint32_t q = 0; q < queued.size() && has_free_task(state.tasks); ++q) {
        if (!queued.is_used[q] || queued.frame[q] != frame) continue;
        const Row<Bodies> body = queued.body[q];
        if (bodies.task[body] != kNone || opening.frame < bodies.retry_frame[body] || bodies.hold_count[body]) continue;
        if (has_waiting_cut(opening.blows, body)) continue;
        // Older bumps of what presses on it would work for half a second before the load is looked at.
        if (!(queued.load[q] > 0) && has_waiting_load(queued, body)) continue;
        if (queued.load[q] > 0 && opening.models.is_full(state, body)) continue;
        const bool snaps = is_snap(queued.load[q], queued.approach_speed[q]);
        // What asks for a snap has seen to it that nothing else is left.
        const auto may_break = snaps ? may_be_crushed : may_break_again;
        if (may_break(state.structures, bodies.structure[body], settings)) {
            if (snaps && open_snap(opening, q, impact_events)) {
                queued.clear_rows(q, 1);
                continue;
            }
            const Row<Tasks> task = snaps ? Row<Tasks>{} : opening.open(body, queued.approach_speed[q]);
            if (task.exists()) {
                lay_queued(state, queued, task, q);
                const Pose pose = pose_of(bodies, body);
                const Impact impact{body, queued.striker[q], to_world(pose, queued.point[q]),
                                    rotate(pose.orientation, queued.normal[q]), queued.approach_speed[q]};
                ImpactEvent event = event_of(bodies, impact, queued.striker_inverse_mass[q]);
                event.load = queued.load[q];
                impact_events.push(event);
            } else if (opening.models.may_find_room(state, body) &&
                       static_cast<float>(opening.frame - frame) * opening.dt < kMostSecondsQueued) {
                continue;
            }
        }
        queued.clear_rows(q, 1);
    }
}

// Oldest first.
void open_queued(Opening& opening, const DamageSettings& settings, Events<ImpactEvent>& impact_events) {
    const QueuedHits& queued = opening.queued;
    for (uint64_t frame = next_queued_frame(queued, 0); frame < opening.frame && has_free_task(opening.state.tasks);
         frame = next_queued_frame(queued, frame + 1))
        open_queued_of(frame, opening, settings, impact_events);
}

}  // namespace

void open_tasks(Serial, Step step, const Events<Impact>& impacts, const Events<ForeseenHit>& foreseen, WorldRows& rows,
                WaitingHits waiting, RigidWorld& rigid, DamageLedger ledger, OpenedTasks out) {
    out.opened.clear();
    const DamageSettings& settings = ledger.settings;
    const Bodies& bodies = rows.bodies;
    Opening opening{rows,          waiting.queued, waiting.blows, out.opened, out.refused,
                    ledger.models, ledger.counts,  step.frame,    step.dt};
    open_queued(opening, settings, out.impacts);
    const auto all = impacts.all();
    for (size_t i = 0, next; i < all.size(); i = next) {
        next = i + 1;
        while (next < all.size() && all[next].body == all[i].body) ++next;
        const Row<Bodies> body = all[i].body;
        if (leave_nothing(opening, all.subspan(i, next - i), rigid)) continue;
        const Impact first = aimed(rows, all[i]);
        const ImpactEvent event =
            event_of(bodies, first, yielding_of(bodies, first.striker, first.point, first.normal).effective());
        if (settings.allows && !settings.allows(settings.allows_user, event)) continue;
        if (bodies.task[body] != kNone || !has_free_task(rows.tasks) || has_waiting_cut(waiting.blows, body)) {
            queue_hits(all.subspan(i, next - i), opening);
            continue;
        }
        const Row<Tasks> task = opening.open(body, first.approach_speed);
        if (!task.exists()) {
            if (ledger.models.may_find_room(rows, body)) queue_hits(all.subspan(i, next - i), opening);
            continue;
        }
        lay_contacts(all.subspan(i, next - i), first, rows, task);
        out.impacts.push(event);
    }
    BlowOpening blows{opening, rigid, settings, out.impacts};
    open_blows(blows);
    open_ahead(opening, foreseen, settings);
    opening.give_rows();
    share_strikers(rows, {settings, ledger.models}, out.opened.all());
}

}  // namespace cullet
