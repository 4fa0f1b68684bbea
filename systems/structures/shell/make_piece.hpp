// A shell of its own for one component of a broken one; also what compacts a shell that lost pieces.
#pragma once
#include "components/metal_rows.hpp"
#include "systems/structures/shell/group_fragments.hpp"

namespace cullet {

/// A new shell (one user) of the part's elements, or kNone when a table is full (`full` then names its limit). Vertices
/// keep the broken shell's order, so that every prism splits into the same tetrahedra; rows that no element uses are
/// left out. Crack states, headings, strengths, pins stay; displacements, velocities, bans and waiting times are
/// cleared. Material, mean edge, limits, time step and first-crack speed are inherited; masses, cells, hulls and mass
/// properties are made anew; a cell of few elements joins the neighbour that it shares most edges with while both have
/// at most 128. Stiffness is not copied. has_cracks: the piece has a crack tip; with the broken shell's
/// own generation (compacting a shell that stayed whole) any crack. group_fragments must have run on the broken shell
/// since its last change. O(the part).
Row<Structures> make_piece(MetalShellRows rows, Row<Structures> broken, const FragmentPart& part, uint8_t generation,
                           const char** full = nullptr);

/// make_piece in two: first the rows and the cells, which parts of one shell may share, part after part; then what
/// fills them but for the hulls, for all parts at once if need be. In between, Cells.same_cell of the piece names the
/// broken shell's cell that moved whole and unchanged (find_changed_cells has run).
Row<Structures> reserve_piece(MetalShellRows rows, Row<Structures> broken, const FragmentPart& part, uint8_t generation,
                              const char** full = nullptr);
void fill_piece(MetalShellRows rows, Row<Structures> broken, const FragmentPart& part, Row<Structures> piece);

/// The live rows of a shell whose pieces have left, close together, in the same order; cells keep their numbers and
/// hulls, so the rigid body need not be told. Masses and mass properties are summed anew. `whole` is its one part.
Row<Structures> compact_shell(MetalShellRows rows, Row<Structures> old, const FragmentPart& whole,
                              const char** full = nullptr);

/// The rows that make_piece will ask for.
ShellRoom piece_room(ShellView broken, const FragmentPart& part);

}  // namespace cullet
