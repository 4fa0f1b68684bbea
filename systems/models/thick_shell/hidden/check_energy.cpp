#include "systems/models/thick_shell/hidden/energy.hpp"
#include "systems/models/thick_shell/hidden/restart.hpp"
#include "systems/models/thick_shell/hidden/systems.hpp"

namespace cullet {

// The steps granted for this frame end with a restart, because the old side of two-sided columns goes with the step's
// number.
void check_energy(Of<Tasks> task, RunRows& rows, const Blows& blows) {
    const Row<Tasks> t = task.row;
    if (static_cast<TaskState>(rows.tasks.state[t]) == TaskState::Dropped) return;
    if (!is_blown_up(task_energy(rows, t), rows.hidden_runs.start_energy[t])) return;
    if (rows.hidden_runs.redo_count[t] == 2) {
        rows.tasks.state[t] = static_cast<uint8_t>(TaskState::Dropped);
        return;
    }
    ++rows.hidden_runs.redo_count[t];
    rows.hidden_runs.time_step[t] *= 0.5f;
    rows.hidden_runs.damping_time[t] *= 0.5f;
    rows.tasks.steps_granted[t] = 0;
    rows.tasks.state[t] = static_cast<uint8_t>(TaskState::Running);
    start_task(rows, blows, t);
}

}  // namespace cullet
