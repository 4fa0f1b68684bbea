// The drawn mesh of a solid: its skin. Outer triangles are the artist's, cracks and what closed holes lie inside.
#pragma once
#include "components/bodies.hpp"
#include "components/solid_rows.hpp"

namespace cullet {

using DrawnSolids = All<Read<SolidRows>, Bodies, ViewVertices, ViewIndices>;

/// Rows of ViewVertices and of ViewIndices that it takes.
uint32_t view_rows_of_solid(Read<SolidRows> rows, Row<Structures> structure);

/// Into the body's own ranges and run columns; its stamp becomes another. Triangles of a run stand as the skin has
/// them, each with corners of its own. Nothing allocates.
void draw_solid_body(DrawnSolids rows, Row<Bodies> body);

}  // namespace cullet
