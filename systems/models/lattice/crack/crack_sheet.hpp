// From the two sides of a crack to pieces (solid cooking note, 6.3, 6.4 and 6.7).
#pragma once
#include "systems/models/lattice/crack/break_run.hpp"

namespace cullet {

/// Takes the bonds between the two sides in run.side that hang together with the one nearest to `start`, over edges of
/// the lattice. False, and nothing changes: its piece does not fall apart, or a part is too small. Else run.piece, the
/// pieces' volumes and run.sheet are what the crack leaves: the largest part keeps the piece's number.
bool break_sheet(const BreakableSolid& body, BreakRun& run, uint32_t start);

/// The same of all bonds between the two sides, wherever they are. `least`: m3, of a part.
bool break_sides(const BreakableSolid& body, BreakRun& run, uint32_t piece, double least);

/// No other crack of this solve starts near the sheet.
void shield(const BreakableSolid& body, BreakRun& run, uint32_t start);

}  // namespace cullet
