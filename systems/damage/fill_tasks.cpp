#include "systems/brittle/restart.hpp"
#include "systems/systems.hpp"

namespace cullet {

void fill_tasks(Each<TaskOpened> opened, ShellTables shells, Tasks&, TaskContacts&, PatchVertices&) {
    start_task(shells.state, opened->task);
}

}  // namespace cullet
