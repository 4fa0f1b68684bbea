#include "systems/damage/stress_check.hpp"
#include "systems/systems.hpp"

namespace cullet {

void stress_check(Rows<Elements> elements, OfTask task, ShellTables shells, const Tasks& tasks) {
    const ShellView shell(shells.state, tasks.shell[task.row]);
    stress_elements(shell, elements.first - shell.elements().first, elements.count);
}

}  // namespace cullet
