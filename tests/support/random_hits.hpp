// Random shapes, and balls that hit them while they fly: for what must hold in every break.
#pragma once
#include <cmath>

#include "engine/random.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {

/// Numbers of one hit.
struct Draw {
    Random random;
    uint64_t hit;
    uint64_t count = 0;
    double between(double low, double high) { return low + (high - low) * random.uniform(hit, count++); }
    Vec3 in_ball(double radius) {
        for (;;) {
            const Vec3 p{float(between(-1, 1)), float(between(-1, 1)), float(between(-1, 1))};
            if (dot(p, p) <= 1 && dot(p, p) > 1e-4f) return float(radius) * p;
        }
    }
};

struct Shape {
    Model model;
    float radius = 0;  // m, half the diagonal of its bounds
};

/// 0.1 to 0.6 m, of one of the four brittle materials that are not wood, 1 to 4 % of its size thick.
Shape random_shape(uint32_t shape, std::optional<FractureKind> fracture = {});

/// The larger; no number is larger than any, and stays.
inline double worse(double a, double b) {
    return std::isnan(a) || b <= a ? a : b;
}

/// What moves, before the systems of damage and after the births: nothing but them lies between, so that Bullet's
/// solver has no part in it.
struct Watch {
    Matter before;
    double energy_before = 0, of_old_debris = 0;
    uint64_t broke_before = 0;
    uint32_t breaks = 0;
    double most_kept = 0, worst_momentum = 0, worst_mass = 0;

    /// To be called while the world is empty but for the debris of earlier hits, whose energy is left out.
    void begin_hit(const World& world) { of_old_debris = measure_matter(world).kinetic_energy; }
    /// To be called after each system.
    void look(const World& world, const std::string& system);
};

struct Throw {
    ModelId model;
    BodyId body, striker;
};
/// A body that flies and turns, and a ball that catches up with it, towards a place within half its size. `spawn` says
/// how the body breaks.
Throw throw_at(World& world, const Shape& shape, Draw draw, SpawnSettings spawn = {});
/// Removes all shells and the model; a step later the world is empty but for debris.
void clear_away(World& world, ModelId model);
/// Such a throw, and 16 frames; then the world is empty again.
void hit_once(World& world, const Shape& shape, Draw draw, SpawnSettings spawn = {});

}  // namespace cullet::test
