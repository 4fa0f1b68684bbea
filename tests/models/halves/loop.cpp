#include "tests/models/halves/loop.hpp"

#include "systems/tasks/birth_cost.hpp"
#include "tests/models/halves/systems.hpp"

namespace cullet::halves {

InnerLoop<TaskWorld> make_loop() {
    InnerLoop<TaskWorld> loop;
    loop.then<run_crack>().finish();
    return loop;
}

RunCost cost_of(const RunRows& rows, uint32_t task) {
    const uint32_t vertices = rows.shells.vertices[rows.shell_of(rows.tasks.working[task])].count;
    return {vertices, units_of_birth(rows.tasks, task, vertices)};
}

bool works_on(const RunRows&, uint32_t) {
    return true;
}

}  // namespace cullet::halves
