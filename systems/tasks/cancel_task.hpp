// An open task goes as if it had never been: nothing of the body changes.
#pragma once
#include "components/state.hpp"

namespace cullet {

/// Gives back its rows. Whoever it holds is the caller's affair.
void cancel_task(State& state, Row<Tasks> task);

}  // namespace cullet
