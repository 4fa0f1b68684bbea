#include "systems/models/thick_shell/hidden/restart.hpp"
#include "systems/models/thick_shell/hidden/systems.hpp"
#include "systems/models/thick_shell/stiffness/refresh.hpp"
#include "systems/structures/shell/cut_cost.hpp"
#include "systems/structures/shell/cut_shell.hpp"

namespace cullet {
namespace {

// Nothing is left to run: what came apart is found as after any task.
void make_cuts(BodyRows& state, Blows& blows, Row<Tasks> task) {
    Tasks& tasks = state.tasks;
    const Range pins = state.bodies.pins[tasks.body[task]];
    const ShellView shell(state, tasks.working[task]);
    for (uint32_t b = 0; b < blows.size(); ++b) {
        if (blows.task[b] != task.index) continue;
        tasks.units_owed[task] += units_of_cut(state.shells, state.shell_of(tasks.source[task]), blows, b);
        const CutReport report = cut_shell(shell, CutSurface(blows, b), state.pin_boxes, pins, kStiffnessRepair);
        // Pins alone that changed are looked at as an opened edge is.
        tasks.crack_count[task] += report.cut_edges > 0 ? report.cut_edges : report.pins_changed > 0;
        blows.goes_on[b] = report.is_full;
    }
    tasks.state[task] = static_cast<uint8_t>(TaskState::Whole);
}

}  // namespace

void start_tasks(EachOwn<TaskOpened> opened, BodyRows& rows, Blows& blows) {
    const Row<Tasks> task = opened->task;
    if (!rows.tasks.working[task].exists()) return;  // no room
    start_run(rows, blows, task);
    if (is_cut_task(blows, task)) make_cuts(rows, blows, task);
}

}  // namespace cullet
