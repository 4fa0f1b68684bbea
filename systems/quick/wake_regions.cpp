// The quick mode's part of the frame: regions wake before the loop and are closed behind it.
#include "systems/quick/cut_out.hpp"
#include "systems/rigid/body_id.hpp"
#include "systems/systems.hpp"

namespace cullet {

// One after another: rows of springs come from pools.
void wake_regions(Serial, const Events<TaskOpened>& opened, ShellTables shells, Tasks& tasks, TaskContacts&,
                  PatchVertices&, const Bodies& bodies, Events<RefusedEvent>& refused) {
    State& state = shells.state;
    for (const TaskOpened& o : opened) {
        if (!is_quick_task(state, o.task)) continue;
        if (static_cast<TaskState>(tasks.state[o.task]) != TaskState::Running) continue;
        const char* full = "";
        if (!wake_region(state, o.task, &full)) refused.push(refused_event(bodies, tasks.body[o.task], full));
    }
}

void close_regions(Serial, const Events<TaskEnded>& ended, ShellTables shells, Tasks&, TaskContacts&, Fragments&,
                   const Bodies&, Events<CrackStartedEvent>& cracks) {
    State& state = shells.state;
    for (const TaskEnded& e : ended) {
        if (!is_quick_task(state, e.task)) continue;
        close_region(state, e.task);
        if (is_cut_out(state, e.task)) put_back(state, e.task, BodyMotion(state, e.task), cracks);
    }
}

}  // namespace cullet
