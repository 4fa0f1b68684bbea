// The serial half of a stress check: cracks start and run.
#pragma once
#include "components/run_rows.hpp"
#include "systems/models/thick_shell/hidden/crack_sink.hpp"

namespace cullet {

/// Before a run: forget_cracks, and every vertex gets the stress at which it starts a crack.
void begin_cracks(ShellView shell, bool is_fragment);

/// Starts and advances the cracks that the stress check's stresses ask for (thick shell note C1, C2, C3, C5), tips
/// first, then the most overloaded vertex; then limits the stiffness of what changed and rebuilds its rows. Each cut
/// bans starts within 3 l. A tip made at t may advance from t + L / (0.35 c) on. Where there is no room for a cut it is
/// refused and counted, and the shell stays as it is.
/// Adds to the task's crack and start counts, its last event time and the units it owes; the caller rebuilds contact
/// patches. Returns the number of cut edges. Cost: one pass over the elements, about 10 microseconds a cut edge.
uint32_t grow_cracks(RunRows& state, Row<Tasks> task, CrackSink& sink);

}  // namespace cullet
