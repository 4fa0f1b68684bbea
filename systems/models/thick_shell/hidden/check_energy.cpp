#include "systems/models/thick_shell/hidden/energy.hpp"
#include "systems/models/thick_shell/hidden/restart.hpp"
#include "systems/systems.hpp"

namespace cullet {

// The steps granted for this frame end with a restart, because the old side of two-sided columns goes with the step's
// number.
void check_energy(EachBody task, ShellTables shells, const Materials&, const Blows&, Tasks& tasks, TaskContacts&,
                  PatchVertices&) {
    const Row<Tasks> t(task.row);
    if (static_cast<TaskState>(tasks.state[t]) == TaskState::Dropped) return;
    if (!is_blown_up(task_energy(shells.state, t), tasks.start_energy[t])) return;
    if (tasks.redo_count[t] == 2) {
        tasks.state[t] = static_cast<uint8_t>(TaskState::Dropped);
        return;
    }
    ++tasks.redo_count[t];
    tasks.time_step[t] *= 0.5f;
    tasks.damping_time[t] *= 0.5f;
    tasks.steps_granted[t] = 0;
    tasks.state[t] = static_cast<uint8_t>(TaskState::Running);
    start_task(shells.state, t);
}

}  // namespace cullet
