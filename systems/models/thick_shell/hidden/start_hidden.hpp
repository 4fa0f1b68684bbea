#pragma once
#include "components/run_rows.hpp"

namespace cullet {

/// The state at the touch: u = 0, v = V + w x r about the centre of the vertices' masses, probe = beta v on both sides.
/// So the run has the body's momentum. Pinned vertices stand still. Strikers at travel 0 and their start speed. Writes
/// the task's start_energy and steps_done = 0. Needs start_velocity, start_spin, damping_time and the contacts.
void start_hidden(RunRows& state, Row<Tasks> task);

}  // namespace cullet
