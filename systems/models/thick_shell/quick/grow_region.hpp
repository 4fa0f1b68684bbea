// Splits what has stretched too far (thick shell note C3 to C5, paper mode).
#pragma once
#include "systems/models/thick_shell/quick/region.hpp"

namespace cullet {

/// One step's splits: the most strained edges first, each at the end that is a crack's tip, else at a hashed one, along
/// the plane across the edge; at most the body's crack frequency. Then the kind of fracture: fine nothing more; coarse
/// and large close the neighbours to cracks but for the crack's ends, and run both ends on, coarse for six mean edges,
/// large for the body's crack length. Springs, masses, bounds and patches follow. Returns the edges cut.
uint32_t grow_region(RunRows& state, Row<Tasks> task);

/// Vertices split in a step when the game does not say: 64 fine, 16 coarse, 1 large. The note (section 8) has 4 for
/// large fracture; a vase that falls at 4.5 m/s, three ways up, then gives 10 to 18 pieces, with 1 it gives 7 to 14.
uint32_t crack_frequency_of(const RunRows& state, Row<Tasks> task);

}  // namespace cullet
