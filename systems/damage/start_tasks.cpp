#include "systems/brittle/restart.hpp"
#include "systems/systems.hpp"

namespace cullet {

void start_tasks(Each<TaskOpened> opened, ShellTables shells, Tasks&, TaskContacts&, PatchVertices&) {
    start_run(shells.state, opened->task);
}

}  // namespace cullet
