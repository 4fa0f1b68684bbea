#include "systems/models/thick_shell/hidden/strength_factors.hpp"

#include <algorithm>

#include "engine/random.hpp"
#include "systems/models/thick_shell/hidden/crack_rules.hpp"

namespace cullet {

void fill_strength_factors(ShellView shell, uint64_t seed) {
    const Random random{seed};
    const double ln2 = logarithm(2.0);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        // Open at both ends: ln(1 - u) < 0 for the smallest u.
        const double u = (static_cast<double>(random.bits(v) >> 12) + 0.5) * 0x1p-52;
        const double factor = exponential(logarithm(-logarithm(1 - u) / ln2) / kWeibullModulus);
        shell.state.vertices.strength_factor[shell.vertex(v)] =
            static_cast<float>(std::clamp(factor, kLeastStrengthFactor, kMostStrengthFactor));
    }
}

}  // namespace cullet
