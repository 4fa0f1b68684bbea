// Splits what has stretched too far (thick shell note C3 to C5, paper mode).
#pragma once
#include "systems/quick/region.hpp"

namespace cullet {

/// One step's splits: the most strained edges first, each at the end that is a crack's tip, else at a hashed one, along
/// the plane across the edge; at most the body's crack frequency. Then the kind of fracture: fine nothing more; coarse
/// closes the neighbours to cracks but for the crack's ends; large runs both ends on. Springs, masses, bounds and
/// patches follow. Returns the edges cut.
uint32_t grow_region(State& state, Row<Tasks> task);

/// Vertices split in a step when the game does not say: fine, coarse, large (section 8).
uint32_t crack_frequency_of(const State& state, Row<Tasks> task);

}  // namespace cullet
