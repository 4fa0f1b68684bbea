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
        boxes.is_outdated[row] = 0;
        boxes.box[row++] = row_of(box);
        whole.include(box);
    }
    bodies.drawn_box[body] = row_of(whole);
}

namespace {

AxisBox box_of(const std::array<float, 6>& row) {
    return {{row[0], row[1], row[2]}, {row[3], row[4], row[5]}};
}

void bound_triangles(const ViewVertex* vertex, const uint32_t* index, uint32_t count, std::array<float, 6>& row) {
    AxisBox box;
    for (uint32_t i = 0; i < count; ++i) box.include(vertex[index[i]].position);
    row = row_of(box);
}

}  // namespace

void bound_redrawn(Bodies& bodies, Row<Bodies> body, const ViewVertices& vertices, const ViewIndices& indices,
                   ViewBoxes& boxes) {
    const Range drawn = bodies.view_indices[body];
    const ViewVertex* const vertex = vertices.vertex.data() + bodies.view_vertices[body].first;
    const uint32_t* const index = indices.index.data() + drawn.first;
    constexpr uint32_t kIndices = 3 * kTrianglesPerBox;
    AxisBox whole;
    uint32_t row = drawn.first / kViewGranule;
    for (uint32_t from = 0; from < drawn.count; from += kIndices, ++row) {
        if (boxes.is_outdated[row])
            bound_triangles(vertex, index + from, std::min(kIndices, drawn.count - from), boxes.box[row]);
        boxes.is_outdated[row] = 0;
        whole.include(box_of(boxes.box[row]));
    }
    bodies.drawn_box[body] = row_of(whole);
}

void bound_drawn(Each<ShellChanged> changed, Bodies& bodies, const ViewVertices& vertices, const ViewIndices& indices,
                 ViewBoxes& boxes) {
    const Row<Bodies> body = changed->body;
    if (static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Free) return;
    if (changed->is_local)
        bound_redrawn(bodies, body, vertices, indices, boxes);
    else
        bound_view(bodies, body, vertices, indices, boxes);
}

}  // namespace cullet
