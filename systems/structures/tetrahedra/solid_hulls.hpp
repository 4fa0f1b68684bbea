// Convex pieces of a solid as cells of its structure: each hull is a cell with points of its own.
#pragma once
#include <span>

#include "components/solid_rows.hpp"
#include "systems/structures/tetrahedra/cook/convex_pieces.hpp"

namespace cullet {

/// Fills cells and points of a structure that has room for them, and its margin: points are pulled in by it.
void write_hulls(ConvexCells rows, Row<Structures> structure, std::span<const SolidHull> hulls, double thickness);

/// More of them, behind what it has: how many corners each has, and the corners of all.
void add_hulls(ConvexCells rows, Row<Structures> structure, std::span<const uint8_t> sizes,
               std::span<const Vec3> corners);

}  // namespace cullet
