// A damage task from its start.
#pragma once
#include "components/state.hpp"

namespace cullet {

/// Fills the working shell from the body's, makes its stiffness ready, lays patches, gives vertices and strikers the
/// velocities of the touch. Nothing allocates.
void start_task(State& state, Row<Tasks> task);

}  // namespace cullet
