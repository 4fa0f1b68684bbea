// The stiffness of a shell whose pins changed.
#pragma once
#include "components/shell_rows.hpp"

namespace cullet {

/// Limits and rows anew (B7: pins change what an unpinned item is). The time step stays: pins only lower the highest
/// frequency. False: the rows do not fit, which they did before.
bool stiffen_pinned(ShellView shell);

}  // namespace cullet
