// Explosions give a run what it starts with.
#pragma once
#include "components/state.hpp"

namespace cullet {

/// Vertices of the task's shell get their impulses, and the run's energy follows.
void start_explosions(State& state, Row<Tasks> task);

}  // namespace cullet
