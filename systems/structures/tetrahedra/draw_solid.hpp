// The drawn mesh of a solid: its skin. Outer triangles are the artist's, cracks and what closed holes lie inside.
#pragma once
#include "components/body_rows.hpp"

namespace cullet {

/// Rows of ViewVertices and of ViewIndices that it takes.
uint32_t view_rows_of_solid(const SolidRows& rows, Row<Structures> structure);

/// Into the body's own ranges and run columns; its stamp becomes another. Triangles of a run stand as the skin has
/// them, each with corners of its own. Nothing allocates.
void draw_solid_body(BodyRows& rows, Row<Bodies> body);

}  // namespace cullet
