#include "systems/models/thick_shell/stiffness/element_stress.hpp"

#include "systems/models/thick_shell/hidden/crack_candidates.hpp"
#include "systems/models/thick_shell/hidden/systems.hpp"

namespace cullet {

void stress_check(Rows<Elements> elements, Of<Tasks> task, InChunks<TaskStress> rows) {
    const StressView shell(rows.set, rows->tasks.working[task.row]);
    const float start_limit = crack_limits(shell, rows->tasks.strength_scale[task.row]).start;
    stress_elements(shell, elements.first - shell.elements().first, elements.count, start_limit);
}

}  // namespace cullet
