// The triangles of a drawn mesh one by one. The mesh is a list of triangles with corners of their own: triangle s has
// the view vertices and indices 3 s to 3 s + 2. Each is the face or a part of a wall of one element.
#pragma once
#include "systems/structures/shell/draw_shell.hpp"

namespace cullet {

/// Which of an element's triangles: the two faces, then two for the wall below each of its three edges.
inline constexpr uint32_t kOuterFace = 0, kInnerFace = 1, kFirstWall = 2;
inline uint32_t wall_triangle(uint32_t edge, uint32_t half) {
    return kFirstWall + 2 * edge + half;
}
inline uint32_t source_of(uint32_t element, uint32_t which) {
    return kMostDrawnTriangles * element + which;
}

/// One corner of the solid: a vertex on its outer or inner side. Both are one point where the depth is 0.
struct DrawnPoint {
    uint32_t vertex;
    bool is_inner;
    friend bool operator==(const DrawnPoint&, const DrawnPoint&) = default;
};

/// The corners of one triangle of a live element, in the order of its view vertices.
std::array<DrawnPoint, 3> drawn_corners(const ShellView& shell, uint32_t element, uint32_t which);
/// Whether the element has it: walls below free edges alone, and of these no triangle that collapses where depth is 0.
bool is_drawn(const ShellView& shell, uint32_t element, uint32_t which);
/// Number of its run, by kind and material.
uint32_t drawn_run(const ShellView& shell, const DrawnMaterials& materials, uint32_t element, uint32_t which);

/// Both faces, three vertices each.
void write_faces(const ShellView& shell, uint32_t element, ViewVertex* outer, ViewVertex* inner);
/// Of the wall below an edge, `along` metres from the start of its border.
void write_wall(const ShellView& shell, uint32_t element, uint32_t which, float along, ViewVertex* out);
/// Of an edge, outside.
float drawn_length(const ShellView& shell, uint32_t element, uint32_t edge);
Vec3 drawn_place(const ShellView& shell, DrawnPoint point);

/// The free edge that follows edge k of the element along its border: round the end corner through links. A vertex has
/// one fan, so that this is a one-to-one map.
void step_along_border(const ShellView& shell, uint32_t& element, uint32_t& edge);

}  // namespace cullet
