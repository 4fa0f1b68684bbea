#include "systems/tasks/take_out.hpp"

#include "systems/bodies/body_rows.hpp"
#include "systems/models.hpp"
#include "systems/tasks/cancel_task.hpp"

namespace cullet {
namespace {

// Whom the hit on it holds goes on.
void release_strikers(RunRows& rows, Bodies& bodies, RigidWorld& rigid, Row<Tasks> task) {
    const TaskContacts& contacts = rows.task_contacts;
    const uint32_t first = rows.tasks.first_contact[task];
    for (uint32_t c = first; c < first + rows.tasks.contact_count[task]; ++c) {
        const Row<Bodies> striker = contacts.striker[c];
        bool is_repeated = false;
        for (uint32_t before = first; before < c; ++before)
            is_repeated = is_repeated || contacts.striker[before] == striker;
        if (is_repeated || !striker.exists() || bodies.hold_count[striker] == 0) continue;
        if (--bodies.hold_count[striker] == 0) rigid.release(striker);
    }
}

}  // namespace

void drop_hits(WaitingHits waiting, Row<Bodies> body) {
    QueuedHits& queued = waiting.queued;
    for (uint32_t q = 0; q < queued.size(); ++q) {
        if (!queued.is_used[q]) continue;
        if (queued.striker[q] == body) queued.striker[q] = {};
        if (queued.body[q] == body) queued.clear_rows(q, 1);
    }
    for (uint32_t b = 0; b < waiting.blows.size();) {
        if (waiting.blows.body[b] == body)
            remove_blow(waiting.blows, b);
        else
            ++b;
    }
}

void take_out(WorldRows& rows, WaitingHits waiting, RigidWorld& rigid, const DamageModels& models, Row<Bodies> body) {
    Bodies& bodies = rows.bodies;
    const Tasks& tasks = rows.tasks;
    for (uint32_t t = 0; t < tasks.size(); ++t) {
        if (static_cast<TaskState>(tasks.state[t]) == TaskState::Free) continue;
        const uint32_t first = tasks.first_contact[t];
        for (uint32_t c = first; c < first + tasks.contact_count[t]; ++c) {
            // Who struck is gone: the run goes on as it was, and what it takes is booked to what never moves.
            if (rows.task_contacts.striker[c] == body) rows.task_contacts.striker[c] = {};
        }
        if (tasks.body[t] != body) continue;
        if (tasks.is_held[t]) release_strikers(rows, bodies, rigid, Row<Tasks>(t));
        cancel_task(models, rows, Row<Tasks>(t));
    }
    drop_hits(waiting, body);
    // Rows are used again: nobody may take the next one for a parent.
    for (uint32_t b = 0; b < bodies.size(); ++b)
        if (bodies.parent[b] == body) bodies.parent[b] = {};
    if (static_cast<BodyKind>(bodies.kind[body]) != BodyKind::Scenery) rigid.remove(body);
    models.release(rows, body);
    free_body(rows, body);
}

}  // namespace cullet
