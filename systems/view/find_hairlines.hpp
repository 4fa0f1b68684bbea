#pragma once
#include "components/view_lines.hpp"

namespace cullet {

/// Finds the edges of the body's crack faces along the outer and the inner wall whose other side is drawn with the same
/// body: they lie between the same two places and run the other way. Each gives one line. Edges of faces whose other
/// side flew off have no partner and give none, nor do edges of an inner wall that touches the outer one at an end. The
/// lines stand in the order of their places. It works on the drawn mesh alone, so that a loaded world finds the same.
/// Nothing allocates; O(n log n) in the edges of crack faces, about 0.2 microseconds an edge.
void find_hairlines(Bodies& bodies, Row<Bodies> body, const ViewVertices& vertices, const ViewIndices& indices,
                    ViewLines& lines);

}  // namespace cullet
