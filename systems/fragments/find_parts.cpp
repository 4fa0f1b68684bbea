#include "systems/fragments/group_fragments.hpp"
#include "systems/systems.hpp"

namespace cullet {

void find_parts(Each<TaskEnded> ended, ShellTables shells, Tasks& tasks, Fragments& fragments) {
    const uint32_t t = ended->task;
    tasks.part_count[t] = 1;
    if (tasks.crack_count[t] == 0 || static_cast<TaskState>(tasks.state[t]) == TaskState::Dropped) return;
    tasks.part_count[t] = group_fragments(ShellView(shells.state, tasks.shell[t]),
                                          std::span(fragments.part.data() + size_t{t} * kMostParts, kMostParts));
    if (tasks.part_count[t] > 1) tasks.state[t] = static_cast<uint8_t>(TaskState::Broke);
    if (tasks.part_count[t] > kMostParts) tasks.state[t] = static_cast<uint8_t>(TaskState::Dropped);
}

}  // namespace cullet
