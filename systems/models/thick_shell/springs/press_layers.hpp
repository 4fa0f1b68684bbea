// Area and volume energies of springs (thick shell note B4).
#pragma once
#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {

bool has_energies(const ShellSprings& springs, Row<ShellSprings> row);

/// Damage work of a substep of them.
uint64_t units_of_energies(const ShellSprings& springs, Row<ShellSprings> row);

/// Adds to the velocities of the packs' points what a step of the energies gives them, from the positions of `side`.
/// Writes these packs alone, so that packs may be pressed at once, and integrated right behind.
void press_packs(const SteppedView& view, uint32_t side, uint32_t first_pack, uint32_t pack_count);

}  // namespace cullet
