#include "systems/brittle/restart.hpp"
#include "systems/systems.hpp"

namespace cullet {

void fill_tasks(Each<TaskOpened> opened, ShellTables shells, Tasks&) {
    fill_task(shells.state, opened->task);
}

}  // namespace cullet
