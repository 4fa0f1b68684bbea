#include "systems/models/metal_shell/loop.hpp"

#include "systems/models/metal_shell/systems.hpp"
#include "systems/tasks/birth_cost.hpp"

namespace cullet::metal_shell {
namespace {

constexpr uint32_t kUnitsAVertex = 30;  // steps of a hidden run on it: both fields, folds and limits

}  // namespace

InnerLoop<TaskWorld> make_loop() {
    InnerLoop<TaskWorld> loop;
    loop.then<work_impact>().finish();
    return loop;
}

RunCost cost_of(const RunRows& rows, uint32_t task) {
    const Row<Shells> shell = rows.shell_of(rows.tasks.working[task]);
    return {kUnitsAVertex * rows.shells.vertices[shell].count, units_of_birth(rows, task)};
}

bool works_on(const RunRows& rows, uint32_t task) {
    return rows.metal_of(rows.tasks.working[task]).exists();
}

}  // namespace cullet::metal_shell
