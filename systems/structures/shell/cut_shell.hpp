// Takes a wall apart along a surface, at once and without forces.
#pragma once
#include "systems/bodies/pin_boxes.hpp"
#include "systems/structures/shell/cut_surface.hpp"
#include "systems/structures/shell/touched.hpp"

namespace cullet {

/// At a share of the way from the outer surface to the inner twin, rest shape.
inline Vec3 place_in_wall(const ShellView& shell, uint32_t vertex, float share) {
    const Vertices& vertices = shell.state.vertices;
    const uint32_t row = shell.vertex(vertex);
    return vertices.rest[row] + (share * vertices.depth[row]) * vertices.inward[row];
}
/// Halfway: where the surface of a cut is looked for, unless it runs between that and the outer surface alone.
inline Vec3 middle_of_wall(const ShellView& shell, uint32_t vertex) {
    return place_in_wall(shell, vertex, 0.5f);
}

struct CutReport {
    uint32_t inserted = 0;  // vertices put on the surface
    uint32_t cut_edges = 0;
    uint32_t pins_changed = 0;  // vertices that became pinned, or free
    bool is_full = false;       // there was no room for all: what was cut stays cut
};

/// Puts vertices where edges cross the surface. Within kSnap of an end, or where the limits on the shape forbid it
/// (can_insert), an end is as good, but only if it lies near to the surface, seen from the smaller part. Large
/// triangles are parted where the cut says, into slivers if need be. Then opens every edge between two elements whose
/// middles lie on different sides, and gives every fan its vertex. What ends inside of the wall is a crack tip. `pins`:
/// the body's boxes; a vertex at the cut stands for where the cut runs on the side that its elements are on, and is
/// pinned when a box holds that place. Needs no stiffness, and lets go of what the shell has assembled: a later hit
/// assembles it anew. O(elements).
CutReport cut_shell(ShellView shell, const CutSurface& surface, const PinBoxes& pin_boxes, Range pins,
                    const CutRepair& repair);

}  // namespace cullet
