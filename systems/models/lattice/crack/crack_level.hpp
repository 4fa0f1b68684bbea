// A curved crack: the level of a scalar whose gradient follows the first principal direction (solid cooking note, 6.3).
#pragma once
#include "systems/models/lattice/crack/break_run.hpp"

namespace cullet {

/// Of cells of the piece at work: how sure the first principal direction is, and that direction, of either sign.
void find_directions(BreakRun& run);
/// Some of the matrix of the scalar, which is the same for all cracks of one solve. True: its factor is made.
bool factor_field(const BreakableSolid& body, BreakRun& run, uint64_t work);

/// Which side of a crack from `cell` each cell of its piece is on, in run.side: by the scalar's level, or by a plane
/// across `normal`.
void part_by_level(const BreakableSolid& body, BreakRun& run, uint32_t cell);
void part_by_plane(const BreakableSolid& body, BreakRun& run, uint32_t cell, Vec3d normal);

}  // namespace cullet
