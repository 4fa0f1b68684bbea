#include "systems/systems.hpp"

namespace cullet {

// In steps, rounded to the nearest; their rows are free for what comes.
void fade_debris(Serial, Step step, Debris& debris, const DebrisAges& ages, const DamageSettings& settings,
                 DamageCounts& counts) {
    if (!(settings.debris_seconds > 0)) return;
    const auto frames = static_cast<uint64_t>(settings.debris_seconds / step.dt + 0.5f);
    for (uint32_t d = 0; d < debris.size() && d < ages.size(); ++d) {
        if (!debris.is_used[d] || step.frame < ages.born[d] + frames) continue;
        debris.clear_rows(d, 1);
        ++counts.faded;
    }
}

}  // namespace cullet
