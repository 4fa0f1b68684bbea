#include "tests/models/halves/loop.hpp"

#include "systems/tasks/birth_cost.hpp"
#include "tests/models/halves/systems.hpp"

namespace cullet::halves {

InnerLoop<LoopWorld> make_loop() {
    InnerLoop<LoopWorld> loop;
    loop.then<run_crack>().finish();
    return loop;
}

RunCost cost_of(const RunRows& rows, uint32_t task) {
    return {rows.shells.vertices[rows.shell_of(rows.tasks.working[task])].count, units_of_birth(rows, task)};
}

bool works_on(const RunRows&, uint32_t) {
    return true;
}

bool may_be_shared(const RunRows&, uint32_t) {
    return false;
}

}  // namespace cullet::halves
