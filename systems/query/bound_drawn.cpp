#include "systems/query/bound_drawn.hpp"

#include "systems/query/box_levels.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

std::array<float, 6> row_of(const AxisBox& e) {
    return {e.low.x, e.low.y, e.low.z, e.high.x, e.high.y, e.high.z};
}

}  // namespace

void bound_view(Bodies& bodies, Row<Bodies> body, const ViewVertices& vertices, const ViewIndices& indices,
                ViewBoxes& boxes) {
    const Range drawn = bodies.view_indices[body];
    const ViewVertex* const vertex = vertices.vertex.data() + bodies.view_vertices[body].first;
    const uint32_t* const index = indices.index.data() + drawn.first;
    AxisBox whole;
    uint32_t row = drawn.first / kViewGranule;
    for (uint32_t from = 0; from < drawn.count; from += 3 * kTrianglesPerBox) {
        AxisBox box;
        for (uint32_t i = from; i < std::min(from + 3 * kTrianglesPerBox, drawn.count); ++i)
            box.include(vertex[index[i]].position);
        boxes.box[row++] = row_of(box);
        whole.include(box);
    }
    bodies.drawn_box[body] = row_of(whole);
}

void bound_drawn(Each<ShellChanged> changed, Bodies& bodies, const ViewVertices& vertices, const ViewIndices& indices,
                 ViewBoxes& boxes) {
    const Row<Bodies> body = changed->body;
    if (static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Free) return;
    bound_view(bodies, body, vertices, indices, boxes);
}

}  // namespace cullet
