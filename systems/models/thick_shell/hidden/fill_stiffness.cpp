#include <algorithm>

#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/systems.hpp"

namespace cullet {

void fill_stiffness(Each<StiffnessWanted> wanted, RunRows& rows) {
    if (static_cast<TaskState>(rows.tasks.state[wanted->task]) == TaskState::Dropped) return;
    const ShellView shell(rows, rows.tasks.working[wanted->task]);
    const uint32_t end = wanted->first_pack + kRowsPerChunk<StiffnessPacks>;
    [[maybe_unused]] const bool is_whole =
        assemble_packs(shell, wanted->first_pack, std::min(end, shell.shells().packs[shell.row].count));
    CULLET_ASSERT(is_whole, "packs from %u on of task %u were laid with too few slots", wanted->first_pack,
                  wanted->task.index);
}

}  // namespace cullet
