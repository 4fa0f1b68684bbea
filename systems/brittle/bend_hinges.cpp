#include "systems/damage/stress_check.hpp"
#include "systems/systems.hpp"

namespace cullet {

void bend_hinges(Rows<Hinges> hinges, OfTask task, Turn turn, ShellTables shells, const Tasks& tasks) {
    const ShellView shell(shells.state, tasks.shell[task.row]);
    bend_hinges(shell, turn.new_side, hinges.first - shell.hinges().first, hinges.count);
}

}  // namespace cullet
