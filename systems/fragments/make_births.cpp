#include "systems/damage/thresholds.hpp"
#include "systems/fragments/break_body.hpp"
#include "systems/rigid/body_id.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

void close_task(State& state, Row<Tasks> task, Step step) {
    Tasks& tasks = state.tasks;
    const Row<Bodies> body = tasks.body[task];
    state.bodies.task[body] = kNone;
    state.bodies.retry_frame[body] = step.frame + retry_frames(step.dt);
    release_shell(state, tasks.shell[task]);
    release_shell(state, tasks.source[task]);
    tasks.state[task] = static_cast<uint8_t>(TaskState::Free);
}

}  // namespace

void make_births(Serial, Step step, const Events<TaskEnded>& ended, ShellTables shells, Tasks& tasks,
                 const TaskContacts&, Fragments&, Bodies& bodies, Debris&, ViewVertices&, ViewIndices&,
                 RigidWorld& rigid, const DamageSettings& settings, DamageCounts& counts, Arena& arena,
                 Events<ShellChanged>& changed, Events<FragmentBornEvent>& born, Events<DebrisEvent>& debris_events,
                 Events<RefusedEvent>& refused, Events<FaultEvent>& faults) {
    Births births{shells.state, rigid, settings, counts, arena, changed, born, debris_events, refused, step};
    for (const TaskEnded& e : ended) {
        const Row<Tasks> task = e.task;
        switch (static_cast<TaskState>(tasks.state[task])) {
            case TaskState::Broke:
                ++counts.broke;
                counts.late += tasks.is_late[task];
                break_body(births, task);
                break;
            case TaskState::Whole:
                ++counts.whole;
                if (tasks.crack_count[task]) keep_cracks(births, task);
                pay_debt(births, task);
                break;
            default:
                ++counts.dropped;
                pay_debt(births, task);
                faults.push(
                    {body_id(bodies, tasks.body[task]),
                     "A hit gained energy three times over, or made more than 1024 pieces; the body stays as it was."});
        }
        counts.cuts += tasks.crack_count[task];
        counts.starts += tasks.start_count[task];
        counts.redone += tasks.redo_count[task];
        close_task(shells.state, task, step);
    }
}

}  // namespace cullet
