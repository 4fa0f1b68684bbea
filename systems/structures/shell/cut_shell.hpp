// Takes a wall apart along a surface, at once and without forces.
#pragma once
#include "systems/structures/shell/cut_surface.hpp"
#include "systems/structures/shell/pin_boxes.hpp"
#include "systems/structures/shell/touched.hpp"

namespace cullet {

/// Halfway between the outer surface and the inner twin, rest shape: where the surface of a cut is looked for.
inline Vec3 middle_of_wall(const ShellView& shell, uint32_t vertex) {
    const Vertices& vertices = shell.state.vertices;
    const uint32_t row = shell.vertex(vertex);
    return vertices.rest[row] + (0.5f * vertices.depth[row]) * vertices.inward[row];
}

struct CutReport {
    uint32_t inserted = 0;  // vertices put on the surface
    uint32_t cut_edges = 0;
    uint32_t pins_changed = 0;  // vertices that became pinned, or free
    bool is_full = false;       // there was no room for all: what was cut stays cut
};

/// Puts vertices where edges cross the surface, if C5's limits on the shape allow it and not within kSnap of an end;
/// then opens every edge between two elements whose middles lie on different sides, and gives every fan its vertex.
/// What ends inside of the wall is a crack tip. `pins`: the body's boxes; a vertex at the cut stands for where the cut
/// runs on the side that its elements are on, and is pinned when a box holds that place. Needs no stiffness, and lets
/// go of what the shell has assembled: a later hit assembles it anew. O(elements).
CutReport cut_shell(ShellView shell, const CutSurface& surface, Range pins, const CutRepair& repair);

}  // namespace cullet
