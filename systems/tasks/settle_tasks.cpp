#include "components/body_id.hpp"
#include "systems/births/strike_back.hpp"
#include "systems/bodies/blows.hpp"
#include "systems/bodies/thresholds.hpp"
#include "systems/models.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

void hold(Bodies& bodies, RigidWorld& rigid, Row<Bodies> b) {
    if (is_dynamic(bodies, b) && bodies.hold_count[b]++ == 0) rigid.hold(b);
}
void let_go(Bodies& bodies, RigidWorld& rigid, Row<Bodies> b) {
    if (is_dynamic(bodies, b) && bodies.hold_count[b] > 0 && --bodies.hold_count[b] == 0) rigid.release(b);
}

template <class F>
void for_body_and_strikers(const Tasks& tasks, const TaskContacts& contacts, uint32_t t, F&& call) {
    call(tasks.body[t]);
    for (uint32_t c = tasks.first_contact[t]; c < tasks.first_contact[t] + tasks.contact_count[t]; ++c) {
        bool is_first = true;
        for (uint32_t before = tasks.first_contact[t]; before < c; ++before)
            is_first = is_first && contacts.striker[before] != contacts.striker[c];
        if (is_first) call(contacts.striker[c]);
    }
}

}  // namespace

// Hold and release both happen here, between detect and solve, so a release is bit for bit as if never held. A blow
// slower than the first crack is solved at once: a harmless bump must not be seen to stick.
void settle_tasks(Serial, Step step, RunTables runs, Bodies& bodies, const Structures& structures, RigidWorld& rigid,
                  DamageLedger ledger, Events<TaskEnded>& ended, ToldOfHits told) {
    ended.clear();
    for (uint32_t t = 0; t < runs.tasks.size(); ++t) {
        const auto task_state = static_cast<TaskState>(runs.tasks.state[t]);
        if (task_state == TaskState::Free || is_ahead(runs.tasks, t)) continue;
        const bool is_over = task_state != TaskState::Running;
        if (!is_over && !runs.tasks.is_held[t] && !runs.tasks.is_late[t]) {
            const bool at_any_speed = ledger.models.breaks_at_any_speed(structures, runs.tasks.source[t]);
            if (is_worth_a_hold(structures, runs.tasks, t, ledger.settings, at_any_speed)) {
                runs.tasks.is_held[t] = 1;
                for (ImpactEvent& e : told.impacts.all())
                    e.is_held = e.is_held || e.body == body_id(bodies, runs.tasks.body[t]);
                for_body_and_strikers(runs.tasks, runs.contacts, t, [&](Row<Bodies> b) { hold(bodies, rigid, b); });
            } else {
                runs.tasks.is_late[t] = 1;
                pay_blows(runs.blows, bodies, rigid, ledger.counts, Row<Tasks>(t));
            }
        }
        if (runs.tasks.is_held[t]) {
            const bool is_time_up = static_cast<float>(runs.tasks.frames_held[t] + 1) * step.dt >
                                    ledger.settings.hold_seconds + 0.5f * step.dt;
            if (is_over || is_time_up) {
                for_body_and_strikers(runs.tasks, runs.contacts, t, [&](Row<Bodies> b) { let_go(bodies, rigid, b); });
                runs.tasks.is_held[t] = 0;
                runs.tasks.is_late[t] = !is_over;
                if (!is_over) {
                    pay_answers(bodies, runs.tasks, runs.contacts, rigid, Row<Tasks>(t));
                    pay_blows(runs.blows, bodies, rigid, ledger.counts, Row<Tasks>(t));
                }
            } else {
                ++runs.tasks.frames_held[t];
                ++ledger.counts.frames_held;
            }
        }
        if (is_over) ended.push({Row<Tasks>(t), structures.damage_model[runs.tasks.source[t]]});
        if (is_over && runs.tasks.lacks_room[t]) {
            ++ledger.counts.cuts_refused;
            told.refused.push(refused_event(bodies, runs.tasks.body[t], kCrackRoom));
        }
    }
}

}  // namespace cullet
