#pragma once
#include "components/state.hpp"
#include "components/view_boxes.hpp"

namespace cullet {

/// Boxes of the body's drawn triangles, and the one of all of them. 3 ns a triangle.
void bound_view(Bodies& bodies, Row<Bodies> body, const ViewVertices& vertices, const ViewIndices& indices,
                ViewBoxes& boxes);

}  // namespace cullet
