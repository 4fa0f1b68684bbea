// Stress of both faces of every triangle (thick shell note C1): sigma = C (eps -+ (h/2) kappa), outer face minus. Two
// passes over the elements, the second after all of the first; each may run in chunks, on any threads, in any order.
//
// A hinge's angle is the sum of the slopes of its two triangles against the edge. So the first pass, which has a
// triangle's corners in registers, gives both its strain and three slopes. The second reads the other three where
// Elements.other_slope says. A pass over hinges that gathers four vertices each took as long as the rest; slopes
// scattered to the hinges instead of gathered across them cost a quarter more.
//
// Displacements are read from side `side` of the probe. That is the side which the next step will read, so the stress
// is that of 0.15 dt later than u: the strain that the next forces come from. (kinetic_energy can put u itself there.)
#pragma once
#include <span>

#include "components/shell_groups.hpp"

namespace cullet {

using StressView = ShellIn<StressTables>;

/// First pass, elements [first, first + count): membrane stress (kept in outer_stress) and Elements.slope. `first` is a
/// multiple of 8, `count` too unless the range ends with the shell's last element.
void strain_elements(StressView shell, uint32_t side, uint32_t first, uint32_t count);
/// Second pass: Elements.outer_stress, inner_stress (in the triangle's axes, scaled by B7's limit) and principal, the
/// larger of both faces, and over_limit: where that is above `start_limit`, Pa, times start_strength. Ranges as above.
void stress_elements(StressView shell, uint32_t first, uint32_t count, float start_limit);
inline constexpr float kNeverStarts = 1e30f;  // Pa
/// Elements.other_slope, for the passes above: of all elements, or of those round vertices where a cut or an insert
/// changed neighbours.
void link_slopes(ShellView shell);
void link_slopes(ShellView shell, std::span<const uint32_t> vertices);
/// Links, and both passes over the whole shell.
void check_stress(ShellView shell, uint32_t side);

/// Like strain_elements, but returns the membrane energy of the elements, J, and leaves their stress alone.
double membrane_energy(StressView shell, uint32_t side, uint32_t first, uint32_t count);

}  // namespace cullet
