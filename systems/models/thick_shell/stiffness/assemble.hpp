// Stiffness of a shell: coupled springs and hinges (thick shell note B3), their limits (B7), and the rows that the
// hidden step multiplies (section 10). Intact model, in this order:
//
//     assemble_springs -> measure_limits -> limit_all_stiffness -> assemble_stiffness -> stable_time_step
//
// After a cut, split or insert of vertices V (masses re-summed):
//
//     assemble_element / assemble_hinge for what changed -> limit_stiffness(V) -> rebuild_rows
#pragma once
#include <span>

#include "components/shell_rows.hpp"
#include "systems/structures/shell/vertex_list.hpp"

namespace cullet {

/// TriangleSprings and Hinges rows of all elements from rest, depth and material, scale 1. Hinges.vertex is written
/// from the elements' hinge ids; a hinge row that no element names is dead.
void assemble_springs(ShellView shell);
/// One element's TriangleSprings row after its corners moved or changed. A triangle without area gets no stiffness.
void assemble_element(ShellView shell, uint32_t element);
/// One Hinges row from its four vertices (already written), scale 1. Returns `hinge`.
uint32_t assemble_hinge(ShellView shell, uint32_t hinge);

/// Bounds of the stiffness/mass ratios: min(4 medians, largest among items without a pinned corner). Allocates
/// (cooking, and spawning with pins).
void measure_limits(ShellView shell);
/// B7's scales of everything that touches these vertices, from present masses. An item takes the smallest of its own
/// factor and those of its corners. `rows` gains each vertex of an item whose scale changed.
void limit_stiffness(ShellView shell, std::span<const uint32_t> vertices, VertexList& rows);
void limit_all_stiffness(ShellView shell);

/// Blocks, links and vertices that assembly will need for the shell plus `spare_vertices`: packs for the spare
/// vertices, and room to move one pack in three. The other members are 0.
ShellRoom stiffness_room(ShellView shell, uint32_t spare_vertices);
/// The same of a shell whose vertices take these slots, one after another (slots_of_corner).
ShellRoom stiffness_room(ShellView shell, std::span<const uint32_t> slots, uint32_t spare_vertices);
/// What an element adds to the slots that the vertex at its corner k takes: blocks, and above the lowest 16 bits links.
/// An open ring has one neighbour more than elements, which the element at its end adds.
uint32_t slots_of_corner(bool ends_ring, bool has_hinge_opposite, bool has_grain);
/// All packs, blocks, links into the shell's ranges. False when the ranges are too small (see stiffness_room).
bool assemble_stiffness(ShellView shell);
/// The same in two: the packs' places, then the rows of packs [first, end), different ones at once if need be.
bool lay_packs(ShellView shell);
bool assemble_packs(ShellView shell, uint32_t first, uint32_t end);
/// Rows of these vertices from their elements, bit for bit what assemble_stiffness would give them. A pack without a
/// free slot moves to the spare end of the shell's ranges. False: out of spare; the rows not yet rebuilt are as before.
bool rebuild_rows(ShellView shell, std::span<const uint32_t> vertices);
/// The row of `vertex` names `to` wherever it named `from`: the same stiffness against a copy of a neighbour.
void rename_neighbour(ShellView shell, uint32_t vertex, uint32_t from, uint32_t to);

/// 0.6 * 2 / omega_max, s, from 40 power iterations on the assembled rows (cooking; allocates). 0 for a body that
/// nothing holds together.
float stable_time_step(ShellView shell);

}  // namespace cullet
