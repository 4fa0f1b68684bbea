// Crack lines follow edges of the mesh; what is drawn of them is smoothed.
#pragma once
#include "components/state.hpp"

namespace cullet {

/// Writes Vertices.drawn_shift: crack vertices move to (1/4, 1/2, 1/4) of their line in the tangent plane (thick shell
/// note C6). Call it when a task has ended, before its pieces are made: both sides of a crack must still be in one
/// shell. A vertex moves when exactly two copies of it stand at one place, and their lines run through the same two
/// places; then both move alike and the sides still fit. Junctions, tips, and ends on a rim stay; older lines, whose
/// other side has gone, keep the shift that they have. A move that would leave an element beside it less than 0.2 of a
/// tetrahedron is taken back. Only drawing sees the shift: rest positions carry springs and masses, and moving those
/// would change both. Nothing allocates. O(elements + c log c) for c crack vertices. Returns how many vertices moved.
uint32_t smooth_crack_lines(ShellView shell);

}  // namespace cullet
