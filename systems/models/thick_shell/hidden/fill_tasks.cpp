#include "systems/models/thick_shell/hidden/restart.hpp"
#include "systems/systems.hpp"

namespace cullet {

void fill_tasks(Each<TaskOpened> opened, ShellTables shells, Tasks& tasks) {
    if (!tasks.shell[opened->task].exists()) return;  // no room
    fill_task(shells.state, opened->task);
}

}  // namespace cullet
