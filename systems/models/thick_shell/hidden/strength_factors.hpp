// How strong each place of a shell is.
#pragma once
#include "components/shell_rows.hpp"

namespace cullet {

/// Strength of every vertex over the median. It is Weibull's of modulus 12, factor = (-ln(1 - u) / ln 2)^(1/12),
/// clamped to [0.5, 1.5]. u is a hash of (seed, vertex), so that a shell's weak places do not depend on what else is in
/// the world.
void fill_strength_factors(ShellView shell, uint64_t seed);

}  // namespace cullet
