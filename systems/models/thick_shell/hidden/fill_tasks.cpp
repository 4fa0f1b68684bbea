#include "systems/models/thick_shell/hidden/restart.hpp"
#include "systems/models/thick_shell/hidden/strength_factors.hpp"
#include "systems/models/thick_shell/hidden/systems.hpp"

namespace cullet {

void fill_tasks(EachOwn<TaskOpened> opened, RunRows& rows) {
    if (!rows.tasks.working[opened->task].exists()) return;  // no room
    fill_task(rows, opened->task);
    if (const uint64_t seed = rows.tasks.strength_seed[opened->task])
        fill_strength_factors(ShellView(rows, rows.tasks.working[opened->task]), seed);
}

}  // namespace cullet
