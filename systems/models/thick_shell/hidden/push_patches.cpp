#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/models/thick_shell/hidden/systems.hpp"

namespace cullet {

void push_patches(Of<Tasks> task, PatchTables rows) {
    const Row<Tasks> t = task.row;
    const bool touches = contact_forces(rows, t);
    if (touches)
        rows.hidden_runs.last_event_time[t] =
            static_cast<float>(rows.tasks.steps_done[t]) * rows.hidden_runs.time_step[t];
}

}  // namespace cullet
