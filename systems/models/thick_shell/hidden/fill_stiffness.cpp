#include <algorithm>

#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/hidden/systems.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"

namespace cullet {

void want_stiffness(Serial, Own<TaskOpened> opened, RunKinds rows, Events<StiffnessWanted>& wanted) {
    wanted.clear();
    for (const TaskOpened& o : opened) {
        const bool runs = static_cast<TaskState>(rows.tasks.state[o.task]) == TaskState::Running;
        if (!runs || is_quick_task(rows, o.task)) continue;
        const uint32_t packs = packs_to_assemble(rows, o.task);
        for (uint32_t p = 0; p < packs; p += kRowsPerChunk<StiffnessPacks>) wanted.push({o.task, p});
    }
}

void fill_stiffness(Each<StiffnessWanted> wanted, RunRows& rows) {
    const ShellView shell(rows, rows.tasks.working[wanted->task]);
    const uint32_t end = wanted->first_pack + kRowsPerChunk<StiffnessPacks>;
    [[maybe_unused]] const bool is_whole =
        assemble_packs(shell, wanted->first_pack, std::min(end, shell.shells().packs[shell.row].count));
    CULLET_ASSERT(is_whole, "packs from %u on of task %u were laid with too few slots", wanted->first_pack,
                  wanted->task.index);
}

}  // namespace cullet
