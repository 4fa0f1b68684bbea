#pragma once
#include "components/body_rows.hpp"
#include "components/view_boxes.hpp"

namespace cullet {

/// Boxes of the body's drawn triangles, and the one of all of them. 5 to 30 ns a triangle, as its corners lie in
/// the cache or not.
void bound_view(Bodies& bodies, Row<Bodies> body, const ViewVertices& vertices, const ViewIndices& indices,
                ViewBoxes& boxes);

/// The same after redraw_body: of the boxes marked as outdated.
void bound_redrawn(Bodies& bodies, Row<Bodies> body, const ViewVertices& vertices, const ViewIndices& indices,
                   ViewBoxes& boxes);

}  // namespace cullet
