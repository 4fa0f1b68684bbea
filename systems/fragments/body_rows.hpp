// Rows of Bodies come and go; generations tell stale handles.
#pragma once
#include "components/state.hpp"

namespace cullet {

/// A cleared row with a new generation, or one that does not exist when limits.bodies is reached.
Row<Bodies> take_body(State& state);
/// Gives back the row, its shell and its drawn mesh. The rigid world's body and open tasks are the caller's affair.
void free_body(State& state, Row<Bodies> body);
/// Ranges of the drawn mesh for the body's present shell; false when limits.view_vertices is reached, and nothing
/// changes.
bool take_view(State& state, Row<Bodies> body);

}  // namespace cullet
