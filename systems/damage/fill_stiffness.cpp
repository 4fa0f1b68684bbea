#include <algorithm>

#include "systems/damage/assemble.hpp"
#include "systems/systems.hpp"

namespace cullet {

void fill_stiffness(Each<StiffnessWanted> wanted, ShellTables shells, const Tasks& tasks) {
    if (static_cast<TaskState>(tasks.state[wanted->task]) == TaskState::Dropped) return;
    const ShellView shell(shells.state, tasks.shell[wanted->task]);
    const uint32_t end = wanted->first_pack + kRowsPerChunk<StiffnessPacks>;
    assemble_packs(shell, wanted->first_pack, std::min(end, shell.shells().packs[shell.row].count));
}

}  // namespace cullet
