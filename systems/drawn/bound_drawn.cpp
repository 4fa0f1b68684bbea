#include "systems/drawn/bound_drawn.hpp"

#include "systems/hulls/box_levels.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

std::array<float, 6> row_of(const AxisBox& e) {
    return {e.low.x, e.low.y, e.low.z, e.high.x, e.high.y, e.high.z};
}
AxisBox box_of(const std::array<float, 6>& row) {
    return {{row[0], row[1], row[2]}, {row[3], row[4], row[5]}};
}

/// Boxes of the drawn triangles, those that are outdated or all, and the box about them.
void bound(Bodies& bodies, Row<Bodies> body, const ViewVertices& vertices, const ViewIndices& indices, ViewBoxes& boxes,
           bool all) {
    const Range drawn = bodies.view_indices[body];
    const ViewVertex* const vertex = vertices.vertex.data() + bodies.view_vertices[body].first;
    const uint32_t* const index = indices.index.data() + drawn.first;
    AxisBox whole;
    uint32_t row = drawn.first / kViewGranule;
    for (uint32_t from = 0; from < drawn.count; from += 3 * kTrianglesPerBox, ++row) {
        if (all || boxes.is_outdated[row]) {
            AxisBox box;
            for (uint32_t i = from; i < std::min(from + 3 * kTrianglesPerBox, drawn.count); ++i)
                box.include(vertex[index[i]].position);
            boxes.box[row] = row_of(box);
        }
        boxes.is_outdated[row] = 0;
        whole.include(box_of(boxes.box[row]));
    }
    bodies.drawn_box[body] = row_of(whole);
}

}  // namespace

void bound_view(Bodies& bodies, Row<Bodies> body, const ViewVertices& vertices, const ViewIndices& indices,
                ViewBoxes& boxes) {
    bound(bodies, body, vertices, indices, boxes, true);
}

void bound_redrawn(Bodies& bodies, Row<Bodies> body, const ViewVertices& vertices, const ViewIndices& indices,
                   ViewBoxes& boxes) {
    bound(bodies, body, vertices, indices, boxes, false);
}

void bound_drawn(Each<DrawnChanged> changed, Bodies& bodies, const ViewVertices& vertices, const ViewIndices& indices,
                 ViewBoxes& boxes) {
    const Row<Bodies> body = changed->body;
    if (static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Free) return;
    if (changed->is_local)
        bound_redrawn(bodies, body, vertices, indices, boxes);
    else
        bound_view(bodies, body, vertices, indices, boxes);
}

}  // namespace cullet
