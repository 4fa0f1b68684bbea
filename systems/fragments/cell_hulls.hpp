// The collision shape of a shell: a convex hull of at most 32 points for each cell.
#pragma once
#include "components/state.hpp"

namespace cullet {

inline constexpr uint32_t kMostHullPoints = 32;

/// The shell's collision margin: 0.2 of its mean depth, at most 1 mm.
float hull_margin(const ShellView& shell);

/// Writes HullPoints, and the counts in Cells, for all cells. Elements must stand sorted by cell (build_shell and
/// make_piece leave them so) and the points' range have 32 rows a cell. Points are outer and inner corners, pulled into
/// the solid by the margin along the shell's normal (at most to the middle of the wall) and away from rims and cracks,
/// so that neighbours along a crack start apart. Of the extremes along 86 directions in the cell's own frame (most of
/// them round the rims of both faces) the 32 are kept that add most reach, fewer when nothing lacks more than 0.05
/// margins. About 35 microseconds a cell of processor time,
/// without AVX.
void build_hulls(ShellView shell);

// The same in steps, for a body that broke: what moved as it was is copied, the other cells are chosen anew, all at
// once if need be, and the points are moved together.

/// Of a piece, sorted by cell: where Cells.same_cell names a cell of `parent`, the body's shell before, and the margins
/// of both are within a twentieth, its points are copied. Elsewhere same_cell becomes kNone: the cell waits.
void copy_piece_hulls(ShellView piece, ShellView parent, float parents_margin);
/// Of what is left of the body, its elements in any order, into its own empty range of points: those of `before` (whose
/// rows of points are `points`) where no element of the cell is changed or dead; same_cell as above.
void copy_rest_hulls(ShellView shell, Range points, ShellView before);
/// A cell that waits. It may have lost all of its elements.
void choose_hull(ShellView shell, uint32_t cell);
/// When no cell waits any more.
void pack_hulls(ShellView shell);

/// Cells.is_changed of `shell`, a cracked copy of `before` with the same cells: where an element is new, has lost a
/// neighbour or a corner, and where the points were stale before.
void find_changed_cells(ShellView shell, ShellView before);
}  // namespace cullet
