#include "systems/tasks/cancel_task.hpp"

#include "systems/models/thick_shell/shared/quick_body.hpp"

namespace cullet {

void cancel_task(BodyRows& state, Row<Tasks> task) {
    Tasks& tasks = state.tasks;
    if (is_quick_task(state, task)) {
        QuickRuns& runs = state.quick_runs;
        runs.springs[task] = {};
        runs.pack_count[task] = 0;
        state.awake_packs.clear_rows(task * kMostAwakePacks, kMostAwakePacks);
    }
    if (task < state.quick_runs.size()) state.quick_runs.cut_elements[task] = 0;
    if (tasks.shell[task].exists()) release_shell(state, tasks.shell[task]);
    release_shell(state, tasks.source[task]);
    state.bodies.task[tasks.body[task]] = kNone;
    tasks.due_frame[task] = 0;
    tasks.state[task] = static_cast<uint8_t>(TaskState::Free);
}

}  // namespace cullet
