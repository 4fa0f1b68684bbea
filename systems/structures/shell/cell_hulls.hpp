// The collision shape of a shell whose cells have shapes of their own: up to four convex hulls of at most 32 points for
// each cell.
#pragma once
#include <algorithm>

#include "components/metal_rows.hpp"

namespace cullet {

/// The shell's collision margin.
float hull_margin(const ShellView& shell);

/// Rows of HullPoints that will do for so many cells.
inline uint32_t most_points(uint32_t cells, uint32_t elements) {
    return std::min(cells * kMostCellPoints, 6 * elements);
}

/// Of sheet metal hollows are not filled by hulls: of an open sheet on both sides, of a closed body on the outer one,
/// since nothing lies inside.
enum class Sheet : uint8_t { None, Open, Closed };
Sheet sheet_of(Tables<const Structures, const MetalOwners, const MetalShells> rows, Row<Structures> structure);

/// Writes HullPoints, and the counts in Cells, for all cells, and the margin. Elements must stand sorted by cell
/// (build_shell and make_piece leave them so) and the points' range have most_points rows. Points are outer and inner
/// corners, pulled into the solid by the margin along the shell's normal (at most to the middle of the wall) and away
/// from rims and cracks, so that neighbours along a crack start apart. A cell is one hull, and up to four where 32
/// points leave out more than half a margin. A hull leaves out what lies less than 0.2 margins above it.
void build_hulls(ShellView shell, Sheet sheet = Sheet::None);

// The same in steps, for a body that broke: what moved as it was is copied, the other cells are chosen anew, all at
// once if need be, and the points are moved together.

/// Of a piece, sorted by cell: where Cells.same_cell names a cell of `parent`, the body's shell before, and the margins
/// of both are within a twentieth, its points are copied. Elsewhere same_cell becomes kNone: the cell waits.
/// `have_cells` false: the body had one shape, and no cell of it hulls.
void copy_piece_hulls(ShellView piece, ShellView parent, float parents_margin, bool have_cells);
/// Of what is left of the body, its elements in any order, into its own empty range of points. They are those of
/// `before` (whose rows of points are `points`) where no element of the cell is changed or dead; same_cell as above.
void copy_rest_hulls(ShellView shell, Range points, ShellView before, bool have_cells = true);
/// Of a piece, and of what is left of a body, that has one shape for all of it (piece_shape.hpp): its cells have none.
void empty_piece_cells(ShellView piece);
void empty_rest_cells(ShellView shell);
/// A cell that waits. It may have lost all of its elements.
void choose_hull(ShellView shell, uint32_t cell, Sheet sheet = Sheet::None);
/// When no cell waits any more.
void pack_hulls(ShellView shell);

/// Of what is left of a body that keeps its points: cells that changed wait, and get room behind all points that are
/// there; the others' same_cell is their own number. O(elements of these cells + cells).
void renew_rest_hulls(ShellView shell);
/// When no cell waits any more: the points of those that did move together. The old ones are left behind them unused.
void pack_renewed_hulls(ShellView shell);
/// Whether there is that room.
bool has_room_to_renew(ShellView shell);

/// Cells.is_changed of `shell`, a cracked copy of `before` with the same cells: where an element is new, has lost a
/// neighbour or a corner, and where the points were stale before (kCracked).
void find_changed_cells(ShellView shell, ShellView before);

}  // namespace cullet
