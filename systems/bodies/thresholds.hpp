// Which contacts are blows.
#pragma once
#include "systems/world_data.hpp"

namespace cullet {

/// A task opens above this share of the first-crack speed; half of it once the body has cracks (section 6.1, 6.4).
inline constexpr float kWakeShare = 0.3f;
/// A generation is counted as far as a byte holds it.
inline constexpr uint32_t kMostGenerations = 255;
/// Between two tries of one body, s.
inline constexpr float kRetrySeconds = 0.02f;

/// Stress grows with the speed up to the first crack, so the game's scale on the strength is one on the speed.
inline float first_crack_speed(const Structures& structures, Row<Structures> s, float strength_scale) {
    return strength_scale * structures.first_crack_speed[s];
}
inline float wake_speed(const Structures& structures, Row<Structures> s, float strength_scale) {
    return kWakeShare * first_crack_speed(structures, s, strength_scale) * (structures.has_cracks[s] ? 0.5f : 1.0f);
}
/// Whether it breaks is known before anybody sees that it stands still: a bump below the speed of the first crack is
/// the solver's affair at once. `breaks_at_any_speed`: what DamageModels says of the task's source.
inline bool is_worth_a_hold(const Structures& structures, const Tasks& tasks, uint32_t task,
                            const DamageSettings& settings, bool breaks_at_any_speed) {
    const Row<Structures> source = tasks.source[task];
    return settings.hold_seconds > 0 &&
           (breaks_at_any_speed ||
            tasks.approach_speed[task] > first_crack_speed(structures, source, tasks.strength_scale[task]));
}
/// Fragments too light, or of too few elements, break no further (section 6.1); the game says where.
inline bool is_worth_breaking(const Structures& structures, Row<Structures> s, const DamageSettings& settings) {
    return structures.generation[s] == 0 ||
           (structures.mass[s] >= double{settings.break_share} * structures.intact_mass[s] &&
            structures.live_elements[s] >= settings.break_elements);
}
/// Nor do those that blows and loads have broken too often.
inline bool may_break_again(const Structures& structures, Row<Structures> s, const DamageSettings& settings) {
    const uint32_t generation = structures.generation[s];
    return generation == 0 || (generation < settings.generations && is_worth_breaking(structures, s, settings));
}
/// What snaps has no last generation, as what is cut, unless the game lets whole bodies break alone.
inline bool may_snap_again(const Structures& structures, Row<Structures> s, const DamageSettings& settings) {
    const uint32_t generation = structures.generation[s];
    return generation == 0 ||
           (settings.generations > 0 && generation < kMostGenerations && is_worth_breaking(structures, s, settings));
}
/// Nothing but the game forbids it to give way to what does not yield.
inline bool may_be_crushed(const Structures& structures, Row<Structures> s, const DamageSettings& settings) {
    return structures.generation[s] == 0 || settings.generations > 0;
}
/// Both halves of it would be more than debris: what may be crushed comes apart so far, and is ground below it.
inline bool may_be_halved(const Structures& structures, Row<Structures> s, const DamageSettings& settings) {
    const uint32_t left = structures.live_elements[s];
    return structures.generation[s] < kMostGenerations && left > 1 && left >= 2 * uint64_t{settings.debris_elements} &&
           structures.mass[s] >= 2 * double{settings.debris_share} * structures.intact_mass[s];
}
inline uint64_t retry_frames(float dt) {
    return 1 + static_cast<uint64_t>(std::ceil(kRetrySeconds / dt));
}

}  // namespace cullet
