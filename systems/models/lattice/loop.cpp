#include "systems/models/lattice/loop.hpp"

#include "systems/models/lattice/systems.hpp"
#include "systems/structures/tetrahedra/skin.hpp"
#include "systems/tasks/birth_cost.hpp"

namespace cullet::lattice {
namespace {}  // namespace

InnerLoop<TaskWorld> make_loop() {
    InnerLoop<TaskWorld> loop;
    loop.then<work_break>().finish();
    return loop;
}

RunCost cost_of(Read<LatticeRows> rows, uint32_t task) {
    return {kUnitsAStep, units_of_birth(rows.tasks, task, points_at_birth(rows, rows.tasks.working[task]))};
}

bool works_on(Read<LatticeRows> rows, uint32_t task) {
    return !is_shell(rows.structures, rows.tasks.source[task]);
}

}  // namespace cullet::lattice
