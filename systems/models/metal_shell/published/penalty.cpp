#include "systems/models/metal_shell/published/penalty.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cullet {
namespace {

constexpr uint32_t kMostSteps = 1u << 20;

}  // namespace

// Velocity first, then place by the new velocity.
PenaltyOutcome press(const PenaltyContact& c) {
    const double stiffness = c.mass * c.speed * c.speed / (c.depth * c.depth);
    const double step = std::numbers::pi * std::sqrt(c.mass / stiffness) / c.steps;
    PenaltyOutcome out;
    double depth = 0, speed = c.speed;
    for (uint32_t n = 0; n < kMostSteps; ++n) {
        const double k = speed > 0 ? stiffness : c.recede * stiffness;
        const double after = speed - k * depth / c.mass * step;
        if (c.splits_turn && speed > 0 && after < 0) {
            const double share = speed / (speed - after);  // of the step, to where it turns
            depth += 0.5 * speed * share * step;
            speed = -c.recede * stiffness * depth / c.mass * (1 - share) * step;
            depth += speed * (1 - share) * step;
        } else {
            speed = after;
            depth += speed * step;
        }
        out.seconds += step;
        out.deepest = std::max(out.deepest, depth);
        if (!(depth > 0)) break;
    }
    out.rebound = -speed;
    out.impulse = c.mass * (c.speed + out.rebound);
    return out;
}

}  // namespace cullet
