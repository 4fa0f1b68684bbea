// What a damage task asks for.
#pragma once
#include "components/body_rows.hpp"

namespace cullet {

/// Rows of a shell and what cracks add to it: a quarter more vertices, at least 640. A vase's first hit adds about 400:
/// a copy for each cut edge inside a crack, and 20 to 110 inserted ones.
ShellRoom working_room(ShellView source);
/// For the quick mode: without stiffness, and with twice as much for cracks.
ShellRoom quick_room(ShellView source);
/// Of a part of a shell, without cells; without stiffness.
ShellRoom quick_room(const MaterialRows& state, Row<Materials> material, uint32_t vertices, uint32_t elements,
                     uint32_t hinges);
ShellRoom hidden_room(const MaterialRows& state, Row<Materials> material, uint32_t vertices, uint32_t elements,
                      uint32_t hinges);

/// False: a working copy of the body's shell has no room beside it even where nothing else is, so that a hit need not
/// wait for it.
bool may_find_room(const BodyRows& state, Row<Bodies> body);

/// Seconds that a hidden run lasts at most: T = max(the material's, 3.6 sqrt(area) / c), c along or across the grain,
/// whichever is slower.
float run_seconds(const MaterialRows& state, uint32_t material, float area);

/// Step, damping time, end and quiet time of a run (B7, 6.4): quiet after 0.4 T.
void set_task_times(RunRows& state, Row<Tasks> task);

}  // namespace cullet
