// Stiffness of a shell: coupled springs and hinges (thick shell note B3), their limits (B7), and the rows that the
// hidden step multiplies (section 10). Intact model, in this order:
//
//     assemble_springs -> measure_limits -> limit_all_stiffness -> assemble_stiffness -> stable_time_step
//
// After a cut, split or insert of vertices V (masses re-summed):
//
//     assemble_element / assemble_hinge for what changed -> limit_stiffness(V) -> row_vertices(V) -> rebuild_rows
#pragma once
#include <span>

#include "components/state.hpp"

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
/// factor and those of its corners.
void limit_stiffness(ShellView shell, std::span<const uint32_t> vertices);
void limit_all_stiffness(ShellView shell);

/// Blocks, links and vertices that assembly will need for the shell plus `spare_vertices`: packs for the spare
/// vertices, and room to move one pack in three. The other members are 0.
ShellRoom stiffness_room(ShellView shell, uint32_t spare_vertices);
/// All packs, blocks, links into the shell's ranges. False when the ranges are too small (see stiffness_room).
bool assemble_stiffness(ShellView shell);
/// Vertices whose rows hold an item that touches `vertices`: themselves, their neighbours, and the corners opposite
/// across hinges. Ascending, each once; returns the count, at most out.size() (more are dropped: give 24 a vertex).
uint32_t row_vertices(ShellView shell, std::span<const uint32_t> vertices, std::span<uint32_t> out);
/// Rows of these vertices from their elements, bit for bit what assemble_stiffness would give them. A pack without a
/// free slot moves to the spare end of the shell's ranges. False: out of spare; the rows not yet rebuilt are as before.
bool rebuild_rows(ShellView shell, std::span<const uint32_t> vertices);

/// 0.6 * 2 / omega_max, s, from 40 power iterations on the assembled rows (cooking; allocates). 0 for a body that
/// nothing holds together.
float stable_time_step(ShellView shell);

}  // namespace cullet
