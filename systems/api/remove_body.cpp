// A body goes, with the hits on it.
#include "systems/api/remove_body.hpp"

#include "components/body_id.hpp"
#include "engine/host_scope.hpp"
#include "systems/api/checks.hpp"
#include "systems/bodies/body_rows.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/models.hpp"
#include "systems/tasks/cancel_task.hpp"
#include "systems/world_contents.hpp"

namespace cullet {

void drop_hits(State& state, Row<Bodies> body) {
    QueuedHits& queued = state.queued_hits;
    for (uint32_t q = 0; q < queued.size(); ++q) {
        if (!queued.is_used[q]) continue;
        if (queued.striker[q] == body) queued.striker[q] = {};
        if (queued.body[q] == body) queued.clear_rows(q, 1);
    }
    for (uint32_t b = 0; b < state.blows.size();) {
        if (state.blows.body[b] == body)
            remove_blow(state.blows, b);
        else
            ++b;
    }
}

void remove_body(WorldData& d, Row<Bodies> body) {
    State& state = d.state;
    Tasks& tasks = state.tasks;
    for (uint32_t t = 0; t < tasks.size(); ++t) {
        if (static_cast<TaskState>(tasks.state[t]) == TaskState::Free) continue;
        const uint32_t first = tasks.first_contact[t];
        for (uint32_t c = first; c < first + tasks.contact_count[t]; ++c) {
            // Who struck is gone: the run goes on as it was, and what it takes is booked to what never moves.
            if (state.task_contacts.striker[c] == body) state.task_contacts.striker[c] = {};
        }
        if (tasks.body[t] != body) continue;
        if (tasks.is_held[t])
            for (uint32_t c = first; c < first + tasks.contact_count[t]; ++c) {
                const Row<Bodies> striker = state.task_contacts.striker[c];
                bool is_repeated = false;
                for (uint32_t before = first; before < c; ++before)
                    is_repeated = is_repeated || state.task_contacts.striker[before] == striker;
                if (is_repeated || !striker.exists() || state.bodies.hold_count[striker] == 0) continue;
                if (--state.bodies.hold_count[striker] == 0) d.rigid->release(striker);
            }
        cancel_task(*d.damage_models, state, Row<Tasks>(t));
    }
    drop_hits(state, body);
    // Rows are used again: nobody may take the next one for a parent.
    for (uint32_t b = 0; b < state.bodies.size(); ++b)
        if (state.bodies.parent[b] == body) state.bodies.parent[b] = {};
    if (static_cast<BodyKind>(state.bodies.kind[body]) != BodyKind::Scenery) d.rigid->remove(body);
    d.damage_models->release(state, body);
    free_body(state, body);
    d.query_index->touch(state.bodies, body);
}

Result<void> World::remove(BodyId id) {
    WorldData& d = contents_->data;
    const Row<Bodies> body = body_row(d.state.bodies, id);
    if (!body.exists()) return stale("body", id.index);
    const HostScope call(contents_->host);
    if (contents_->recorder) contents_->recorder->remove(id);
    remove_body(d, body);
    return {};
}

}  // namespace cullet
