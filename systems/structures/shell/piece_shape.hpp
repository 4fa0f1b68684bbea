// What stands for a new piece in the rigid world. This is the one place that says the rule:
//
//   box    if volume of the tightest box / volume of the solid < 1.15.
//   hull   if volume of the convex hull / volume of the solid < 1.4 and its 32 best points leave out less than the
//          margin.
//   cells  otherwise: convex groups of its elements (cell_hulls.hpp).
//
// The solid is what is drawn, its volume mass / density: the sum of its prisms. Volumes are taken in double, of the
// points as they are drawn and without margin. The core that the rigid world gets lies inside by the margin, which it
// grows by: a box by a margin on each side, a hull's points as cell_hulls.hpp pulls its own. What is drawn so lies
// outside of the shape by no more than a margin: a corner of a box by sqrt 3 - 1 of one.
//
// Only pieces of at most kMostWholeElements are measured. What keeps a body's handle chooses anew when it breaks again;
// with more elements than that its cells go on alone, so that no hit costs what goes with the body. Intact bodies have
// cells, and so has what stands pinned. Others come to rest on it, in notches too, which one hull would fill. Pieces of
// a wall hover by 3 mm and more in 5 of 12 runs over hulls of what stands, in 3 over its cells. Its cells cost nothing
// while it stands.
#pragma once
#include "components/body_rows.hpp"

namespace cullet {

inline constexpr double kMostBoxRatio = 1.15, kMostHullRatio = 1.4;
/// Sixteen cells. All of them may have to be chosen anew by one hit on a piece that had a single shape.
inline constexpr uint32_t kMostWholeElements = 2048;

/// 0.2 of the least width (of a wall: its thickness), at most 1 mm: that much of each side is rounded at edges, and
/// twice that is the least that a core is thick.
float margin_for(double least_width);
/// How far a hull's point lies below the shell's surface, m. `way_in`: of a vertex on a free edge, else 0. A rounded
/// edge lies 0.41 of the margin below the drawn one, and pieces that stand on their edges sink in by that. On free
/// edges points are pulled by 0.85 of the margin: a face stands out by 0.15 of it, and the edge lies 0.31 deep.
float pull_of(float margin, float depth, Vec3 way_in);

inline ShapeKind shape_of(const ShellView& shell) {
    return static_cast<ShapeKind>(shell.structures().shape[shell.structure]);
}

/// Chooses, and writes shape, shape_points and both ratios of the shell's row, and the points into rows of HullPoints
/// from `first_point` on (where there is room for most_points). Without a part: of all elements, and the margin, too.
/// Of a listed part: of what is left of a body, which keeps its margin. Reads and writes nothing of other parts.
void choose_shape(ShellView shell, uint32_t first_point, const FragmentPart* part = nullptr);
/// Cells have their own hulls.
void clear_shape(ShellView shell);

}  // namespace cullet
