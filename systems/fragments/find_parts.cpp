#include "systems/fragments/group_fragments.hpp"
#include "systems/systems.hpp"

namespace cullet {

void find_parts(Each<TaskEnded> ended, ShellTables shells, Tasks& tasks) {
    const uint32_t t = ended->task;
    if (tasks.crack_count[t] == 0 || static_cast<TaskState>(tasks.state[t]) == TaskState::Dropped) return;
    tasks.part_count[t] = group_fragments(ShellView(shells.state, tasks.shell[t]), {});
}

}  // namespace cullet
