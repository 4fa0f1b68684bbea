#include "systems/damage/thresholds.hpp"
#include "systems/fragments/break_body.hpp"
#include "systems/fragments/strike_back.hpp"
#include "systems/rigid/body_id.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

// A crack starts at a vertex that names itself. Vertices keep their numbers in the working shell, so those that did so
// in the body's before the hit are old.
void tell_cracks(State& state, Row<Tasks> task, Events<CrackStartedEvent>& cracks) {
    const Row<Bodies> body = state.tasks.body[task];
    const ShellView now(state, state.tasks.shell[task]), before(state, state.tasks.source[task]);
    const auto is_start = [&](const ShellView& shell, uint32_t v) {
        const uint32_t row = shell.vertex(v);
        return state.vertices.crack_start[row] == v &&
               state.vertices.crack[row] == static_cast<uint8_t>(CrackState::Cracked);
    };
    const bool is_fragment = state.shells.generation[before.row] > 0;  // it has forgotten its old starts (6.1)
    for (uint32_t v = 0; v < now.vertex_count(); ++v) {
        if (!is_start(now, v) || (!is_fragment && v < before.vertex_count() && is_start(before, v))) continue;
        cracks.push({body_id(state.bodies, body), state.bodies.user_data[body],
                     to_world(pose_of(state.bodies, body), state.vertices.rest[now.vertex(v)])});
    }
}

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
                 TaskContacts& contacts, QueuedHits&, Fragments&, Bodies& bodies, Debris&, ViewVertices&, ViewIndices&,
                 RigidWorld& rigid, const DamageSettings& settings, DamageCounts& counts, Arena& arena,
                 Events<ShellChanged>& changed, Events<CrackStartedEvent>& cracks, Events<FragmentBornEvent>& born,
                 Events<DebrisEvent>& debris_events, Events<RefusedEvent>& refused, Events<FaultEvent>& faults) {
    Births births{shells.state, rigid, settings, counts, arena, changed, born, debris_events, refused, step};
    for (uint32_t b = 0; b < bodies.size(); ++b)
        if (bodies.is_owed_births[b] && bodies.task[b] == kNone) ask_again(births, Row<Bodies>(b));
    for (const TaskEnded& e : ended) {
        const Row<Tasks> task = e.task;
        if (static_cast<TaskState>(tasks.state[task]) != TaskState::Dropped && tasks.start_count[task])
            tell_cracks(shells.state, task, cracks);
        switch (static_cast<TaskState>(tasks.state[task])) {
            case TaskState::Broke:
                ++counts.broke;
                counts.late += tasks.is_late[task];
                break_body(births, task);
                break;
            case TaskState::Whole:
                ++counts.whole;
                if (tasks.crack_count[task]) keep_cracks(births, task);
                break;
            default:
                ++counts.dropped;
                faults.push(
                    {body_id(bodies, tasks.body[task]), bodies.user_data[tasks.body[task]],
                     centre_of(bodies, tasks.body[task]),
                     "A hit gained energy three times over, made more than 1024 pieces, or found no room for its "
                     "stiffness; the body stays as it was."});
        }
        pay_answers(bodies, tasks, contacts, rigid, task);
        counts.cuts += tasks.crack_count[task];
        counts.starts += tasks.start_count[task];
        counts.redone += tasks.redo_count[task];
        close_task(shells.state, task, step);
    }
}

}  // namespace cullet
