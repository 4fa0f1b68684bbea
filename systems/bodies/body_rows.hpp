// Rows of Bodies come and go; generations tell stale handles.
#pragma once
#include "components/world_rows.hpp"

namespace cullet {

/// A cleared row with a new generation, or one that does not exist when limits.bodies is reached.
Row<Bodies> take_body(BodyRows& state);
/// Gives back the row, its structure and its drawn mesh. The rigid world's body and open tasks are the caller's affair.
void free_body(WorldRows& state, Row<Bodies> body);
/// Ranges of the drawn mesh for the live elements of the body's present structure: those that it has, when they are
/// large enough. False when limits.view_vertices is reached, and nothing changes. With `may_crack` there are more, if
/// there is room, for what cracks add.
bool take_view(WorldRows& state, Row<Bodies> body, bool may_crack = false);
/// The same of so many rows of each kind.
bool take_view_rows(BodyRows& state, Row<Bodies> body, uint32_t rows);
/// With spare rows, if there is room for them.
bool take_spare_view_rows(BodyRows& state, Row<Bodies> body, uint32_t rows);

}  // namespace cullet
