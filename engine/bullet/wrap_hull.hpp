// Faces and edges of the convex hull of a piece's points, in exact arithmetic and without asking for memory.
#pragma once
#include "engine/bullet/hull.hpp"

namespace cullet::bullet {

/// Writes corners, faces and edges of `hull` from its local points; normals and heights stay to be done. Corners run
/// counter-clockwise seen from outside, an edge goes from a to b along its left face. Points in a plane give the two
/// faces of their polygon, points on a line none. Points that are no corner, and all but the first of those that fall
/// together, appear in no face.
void wrap_hull(Hull& hull);

}  // namespace cullet::bullet
