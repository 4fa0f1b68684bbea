#include "components/body_id.hpp"
#include "systems/births/plan_break.hpp"
#include "systems/models.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

// Bodies that wait are passed over, in silence, while no piece could leave: asking takes as long as a break.
bool may_ask(const Planning& planning, uint8_t owed) {
    return owed == kOwedDrawing || owed == kOwedShape || (planning.fragments_left > 0 && planning.births_left > 0);
}

// What its damage model moves asks with the motion that it has there.
void ask(Planning& planning, Row<Bodies> body) {
    if (planning.models.is_moving(planning.state, body))
        planning.models.look_for_pieces(planning.state, body);
    else
        ask_again(planning, body);
}

}  // namespace

void plan_births(Serial, const Events<TaskEnded>& ended, WorldRows& rows, WaitingHits waiting, Pieces pieces,
                 const Debris& debris, DamageLedger ledger, Arena& arena, PlannedBirths planned) {
    planned.breaks.clear();
    planned.births.clear();
    const Bodies& bodies = rows.bodies;
    const Tasks& tasks = rows.tasks;
    Planning planning{rows,
                      pieces.fragments,
                      pieces.touches,
                      waiting.queued,
                      waiting.blows,
                      ledger.settings,
                      ledger.models,
                      ledger.counts,
                      arena,
                      planned.breaks,
                      planned.births,
                      planned.changed,
                      planned.refused,
                      free_debris(debris),
                      free_fragments(rows.fragment_ages, ledger.settings),
                      ledger.settings.births_a_frame};
    for (uint32_t b = 0; b < bodies.size(); ++b)
        if (bodies.is_owed_births[b] && bodies.task[b] == kNone && may_ask(planning, bodies.is_owed_births[b]))
            ask(planning, Row<Bodies>(b));
    const DamageModels& models = ledger.models;
    for (Row<Bodies> torn = models.take_torn(rows); torn.exists(); torn = models.take_torn(rows))
        plan_tear(planning, torn);
    for (const TaskEnded& e : ended) {
        const Row<Tasks> task = e.task;
        const auto result = static_cast<TaskState>(tasks.state[task]);
        const Row<Structures> working = tasks.working[task];
        const bool is_on_own = working == tasks.source[task];  // of the body, not on a copy
        if (result != TaskState::Dropped && tasks.start_count[task])
            planning.calls(working).tell_cracks(rows, task, planned.cracks);
        if (result == TaskState::Broke) plan_break(planning, task);
        if (result == TaskState::Reshaped || (result == TaskState::Whole && tasks.crack_count[task]))
            keep_cracks(planning, task);
        if (result == TaskState::Whole && !tasks.crack_count[task] && is_on_own)
            planning.calls(working).stop(rows, working);
        // More pieces than there may be, with those that found no room before.
        if (result == TaskState::Dropped && tasks.crack_count[task] && is_on_own)
            planning.calls(working).clear_run(rows, working, {true, false});
        if (result == TaskState::Dropped && working.exists())  // else it was refused
            planned.faults.push(
                {body_id(bodies, tasks.body[task]), bodies.user_data[tasks.body[task]],
                 centre_of(bodies, tasks.body[task]),
                 "A hit gained energy three times over, made more than 1024 pieces, or found no room for its "
                 "stiffness; the body stays as it was."});
    }
}

}  // namespace cullet
