// A shell of its own for one component of a broken one; also what compacts a shell that lost pieces.
#pragma once
#include "components/state.hpp"
#include "systems/fragments/group_fragments.hpp"

namespace cullet {

/// A new shell (one user) of the part's elements, or kNone when a table is full (`full` then names its limit). Vertices
/// keep the broken shell's order, so that every prism splits into the same tetrahedra; rows that no element uses are
/// left out. Crack states, headings, strengths, pins stay; displacements, velocities, bans and waiting times are
/// cleared. Material, mean edge, limits, time step and first-crack speed are inherited; masses, cells, hulls and mass
/// properties are made anew; a cell of few elements joins the neighbour that it shares most edges with while both have
/// at most 128. Stiffness is not copied. has_cracks: the piece has a crack tip; with the broken shell's
/// own generation (compacting a shell that stayed whole) any crack. group_fragments must have run on the broken shell
/// since its last change. With `hulls`, the shell that the body had before, the points of cells that moved whole and
/// unchanged (find_changed_cells has run) are copied from it. O(the part).
Row<Shells> make_piece(State& state, Row<Shells> broken, const FragmentPart& part, uint8_t generation,
                       const char** full = nullptr, Row<Shells> hulls = {});

/// The live rows of a shell whose pieces have left, close together, in the same order; cells keep their numbers and
/// hulls, so the rigid body need not be told. Masses and mass properties are summed anew. `whole` is its one part.
Row<Shells> compact_shell(State& state, Row<Shells> old, const FragmentPart& whole, const char** full = nullptr);

/// The rows that make_piece will ask for.
ShellRoom piece_room(ShellView broken, const FragmentPart& part);

}  // namespace cullet
