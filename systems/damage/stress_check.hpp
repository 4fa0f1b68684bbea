// Stress of both faces of every triangle (thick shell note C1): sigma = C (eps -+ (h/2) kappa), outer face minus. Two
// passes, hinges before elements; each may run in chunks of any size, on any thread, in any order.
//
// Displacements are read from side `side` of the probe. That is the side which the next step will read, so the stress
// is that of 0.15 dt later than u: the strain that the next forces come from. (Or stage_displacements writes u itself.)
#pragma once
#include "components/state.hpp"

namespace cullet {

/// Hinges.angle of hinges [first, first + count), relative to the shell; a dead hinge gets 0.
void bend_hinges(ShellView shell, uint32_t side, uint32_t first, uint32_t count);
/// Elements.outer_stress, inner_stress (in the triangle's axes, scaled by B7's limit) and principal. `first` is a
/// multiple of 8, `count` too unless the range ends with the shell's last element.
void stress_elements(ShellView shell, uint32_t side, uint32_t first, uint32_t count);

/// Membrane energy of elements [first, first + count), J; `first` a multiple of 8.
double membrane_energy(ShellView shell, uint32_t side, uint32_t first, uint32_t count);

}  // namespace cullet
