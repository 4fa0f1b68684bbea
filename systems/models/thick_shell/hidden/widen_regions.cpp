#include "components/body_id.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/systems.hpp"

namespace cullet {

void widen_regions(Serial, ShellTables shells, Tasks& tasks, const Bodies& bodies, Events<TaskOpened>& opened,
                   Events<StiffnessWanted>& stiffness_wanted, Events<RefusedEvent>& refused) {
    State& state = shells.state;
    for (uint32_t t = 0; t < state.region_rests.size(); ++t) {
        const Row<Tasks> task(t);
        if (static_cast<TaskState>(tasks.state[t]) != TaskState::Running || !is_hidden_region(state, t)) continue;
        if (!state.region_rests.wants_more[t]) continue;
        release_shell(state, tasks.shell[t]);
        tasks.shell[t] = {};
        state.quick_runs.cut_elements[t] = 0;
        const char* full = nullptr;
        if (give_hidden_rows(state, task, 2 * state.region_rests.most_vertices[t], stiffness_wanted, &full)) {
            opened.push({task});
        } else {
            tasks.state[t] = static_cast<uint8_t>(TaskState::Dropped);
            refused.push(refused_event(bodies, tasks.body[t], full));
        }
    }
}

}  // namespace cullet
