#include "systems/models/thick_shell/hidden/systems.hpp"
#include "systems/models/thick_shell/stiffness/element_stress.hpp"

namespace cullet {

void strain_check(Rows<Elements> elements, Of<Tasks> task, Turn turn, InChunks<TaskStress> rows) {
    const StressView shell(rows.set, rows->tasks.working[task.row]);
    strain_elements(shell, turn.new_side, elements.first - shell.elements().first, elements.count);
}

}  // namespace cullet
