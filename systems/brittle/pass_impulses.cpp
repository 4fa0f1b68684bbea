#include "systems/brittle/hidden_region.hpp"
#include "systems/damage/contact.hpp"
#include "systems/systems.hpp"

namespace cullet {

// A run ends after T, or after a quiet time since the last crack or touch; contact chatters, so T usually ends it.
void pass_impulses(EachBody task, Turn turn, ShellTables shells, Tasks& tasks, TaskContacts&, const PatchVertices&) {
    const Row<Tasks> t(task.row);
    if (is_hidden_region(shells.state, t)) move_rest(shells.state, t, turn.old_side);
    apply_contact(shells.state, t, turn.old_side);
    tasks.steps_granted[t] -= tasks.steps_granted[t] > 0;
    const float time = static_cast<float>(++tasks.steps_done[t]) * tasks.time_step[t];
    if (time > tasks.end_time[t] || time > tasks.last_event_time[t] + tasks.quiet_time[t])
        tasks.state[t] = static_cast<uint8_t>(TaskState::Whole);  // find_parts tells whether it broke
}

}  // namespace cullet
