#include "systems/models/thick_shell/stiffness/stiffen_pinned.hpp"

#include "systems/models/thick_shell/stiffness/assemble.hpp"

namespace cullet {

bool stiffen_pinned(ShellView shell) {
    assemble_springs(shell);
    measure_limits(shell);
    limit_all_stiffness(shell);
    return assemble_stiffness(shell);
}

}  // namespace cullet
