// Which faces of the growing shell can ever meet (thick shell note A6). Every inner point stays on its segment from the
// surface to its cap, so one search serves all rounds.
#pragma once
#include "systems/hulls/triangle_test.hpp"
#include "systems/structures/shell/cook/extrusion_work.hpp"

namespace cullet {

/// Faces in this order: outer triangles, inner triangles, two rim triangles per border edge. A corner below
/// vertex_count() is an outer point, one above is the inner point of vertex (corner - vertex_count()).
struct ShellFaces {
    uint32_t vertex_count = 0, triangle_count = 0;
    std::vector<Triangle> corners;
    explicit ShellFaces(const Surface& surface);
    uint32_t outer(uint32_t t) const { return t; }
    uint32_t inner(uint32_t t) const { return triangle_count + t; }
    uint32_t rim(uint32_t border, uint32_t half) const { return 2 * triangle_count + 2 * border + half; }
};

struct FacePair {
    uint32_t a, b;  // at least one of them moves
    AxisHint hint;
};

/// Face pairs that no certificate drops for depths up to work.caps.
std::vector<FacePair> list_pairs(const ExtrusionWork& work, const ShellFaces& faces);

}  // namespace cullet
