#include "systems/tasks/cancel_task.hpp"

#include "systems/models.hpp"

namespace cullet {

void cancel_task(const DamageModels& models, WorldRows& state, Row<Tasks> task) {
    Tasks& tasks = state.tasks;
    models.cancel(state, task);
    const StructureCalls& calls = calls_of(state.structures, tasks.source[task]);
    if (tasks.working[task].exists()) calls.release(state, tasks.working[task]);
    calls.release(state, tasks.source[task]);
    state.bodies.task[tasks.body[task]] = kNone;
    tasks.due_frame[task] = 0;
    tasks.state[task] = static_cast<uint8_t>(TaskState::Free);
}

}  // namespace cullet
