// The stress in one piece under the blow.
#pragma once
#include "systems/models/lattice/crack/break_run.hpp"

namespace cullet {

inline constexpr uint64_t kElementWork = 2500, kCellWork = 600;  // multiplications

/// Where the blow does not reach the surface it counts at the nearest place of it.
void move_to_surface(const BreakableSolid& body, BreakRun& run);
/// Force, duration and energy of the blow where it is an explosion.
void measure_blast(const BreakableSolid& body, BreakRun& run);
/// Of the patches of a piece that the blow reaches: 0 means none.
double weight_of(const BreakableSolid& body, const BreakRun& run, uint32_t piece);

/// Lists the cells of run.at_piece, marks them solved and clears what the last solve left.
void list_cells(BreakRun& run);
/// Some of the elements. True: all are in the matrix, the blow's loads are laid and pins are chosen. `is_loaded` false:
/// the blow does not reach this piece, or it is too small for pins.
bool assemble_some(const BreakableSolid& body, BreakRun& run, uint64_t work, bool& is_loaded);
/// Displacements, and by cell stress and its largest principal value: some of them. True: all are there. The first
/// solve tells what share of the contact's force comes.
bool find_some_stress(const BreakableSolid& body, BreakRun& run, uint64_t work);

}  // namespace cullet
