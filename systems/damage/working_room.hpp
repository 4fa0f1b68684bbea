// What a damage task asks for.
#pragma once
#include "components/state.hpp"

namespace cullet {

/// Rows of a shell and what cracks add to it: a quarter more vertices, at least 192. A vase's first hit adds about 400:
/// a copy for each cut edge inside a crack, and 20 to 110 inserted ones.
ShellRoom working_room(ShellView source);

/// Step, damping time, end and quiet time of a run (B7, 6.4): T = max(1 ms, 3.6 sqrt(area) / c), quiet after 0.4 T.
void set_task_times(State& state, const Materials& materials, Row<Tasks> task);

}  // namespace cullet
