// Explosions give a run what it starts with.
#pragma once
#include "components/blows.hpp"
#include "components/run_rows.hpp"

namespace cullet {

/// Vertices of the task's shell get their impulses, and the run's energy follows.
void start_explosions(RunRows& state, const Blows& blows, Row<Tasks> task);

}  // namespace cullet
