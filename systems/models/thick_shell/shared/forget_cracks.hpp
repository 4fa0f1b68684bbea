// What a shell knows of its cracks when a new run begins.
#pragma once
#include "components/shell_rows.hpp"

namespace cullet {

/// No vertex is banned from starting and every tip may advance at once. Cuts, tips and headings stay. A fragment keeps
/// its tips and forgets its other cracks, whose edges are plain borders now (thick shell note 6.1).
void forget_cracks(ShellView shell, bool is_fragment);

}  // namespace cullet
