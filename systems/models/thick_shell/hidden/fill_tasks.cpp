#include "systems/models/thick_shell/hidden/restart.hpp"
#include "systems/systems.hpp"

namespace cullet {

void fill_tasks(EachOwn<TaskOpened> opened, RunRows& rows) {
    if (!rows.tasks.working[opened->task].exists()) return;  // no room
    fill_task(rows, opened->task);
}

}  // namespace cullet
