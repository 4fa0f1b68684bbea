#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/systems.hpp"

namespace cullet {

void push_patches(EachBody task, ShellTables shells, Tasks& tasks, const TaskContacts&, PatchVertices&) {
    const Row<Tasks> t(task.row);
    const bool touches = contact_forces(shells.state, t);
    if (touches) tasks.last_event_time[t] = static_cast<float>(tasks.steps_done[t]) * tasks.time_step[t];
}

}  // namespace cullet
