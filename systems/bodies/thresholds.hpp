// Which contacts are blows.
#pragma once
#include "systems/world_data.hpp"

namespace cullet {

/// A task opens above this share of the first-crack speed; half of it once the body has cracks (section 6.1, 6.4).
inline constexpr float kWakeShare = 0.3f;
/// Between two tries of one body, s.
inline constexpr float kRetrySeconds = 0.02f;

/// Stress grows with the speed up to the first crack, so the game's scale on the strength is one on the speed.
inline float first_crack_speed(const Shells& shells, Row<Shells> s, float strength_scale) {
    return strength_scale * shells.first_crack_speed[s];
}
inline float wake_speed(const Shells& shells, Row<Shells> s, float strength_scale) {
    return kWakeShare * first_crack_speed(shells, s, strength_scale) * (shells.has_cracks[s] ? 0.5f : 1.0f);
}
/// Fragments too light, of too few elements or broken too often break no further (section 6.1); the game says where.
inline bool may_break_again(const Shells& shells, Row<Shells> s, const DamageSettings& settings) {
    const uint32_t generation = shells.generation[s];
    if (generation == 0) return true;
    return generation < settings.generations &&
           shells.mass[s] >= double{settings.break_share} * shells.intact_mass[s] &&
           shells.elements[s].count - shells.dead_elements[s] >= settings.break_elements;
}
inline uint64_t retry_frames(float dt) {
    return 1 + static_cast<uint64_t>(std::ceil(kRetrySeconds / dt));
}

}  // namespace cullet
