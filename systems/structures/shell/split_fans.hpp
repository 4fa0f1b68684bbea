// One vertex a fan.
#pragma once
#include "systems/structures/shell/touched.hpp"

namespace cullet {

/// Fans that `before`, the ring of a vertex before some of its edges were cut, has fallen into: runs of elements that
/// are still linked. 1 when nothing came apart; the vertex then keeps its row.
uint32_t count_fans(ShellView shell, const Ring& before);

/// Gives every fan a vertex of its own: the fan with the smallest element keeps the row, each other fan gets a copy of
/// all columns at the end of the shell's vertices, in ring order. Corners and hinges follow, masses are summed anew.
/// Place, velocity and pins are copied, so mass, momentum and kinetic energy stay as they are. Rows of the stiffness
/// that named the vertex name its copy. Returns the number of copies, whose rows are the last ones; the caller must
/// have asked `count_fans` and made sure of the room.
uint32_t split_fans(ShellView shell, uint32_t vertex, const Ring& before, Touched& touched);

}  // namespace cullet
