// Materials with a grain: strength by the angle to it.
#pragma once
#include "engine/math.hpp"

namespace cullet {

/// Limits along and across a grain, Pa. Without a grain both are the same.
struct GrainLimits {
    bool has_grain = false;
    Vec3 grain;  // unit, body frame
    float start_along = 0, start_across = 0;
    float tip_along = 0, tip_across = 0;
};

/// Hankinson's formula (1921; Wood Handbook, FPL-GTR-190, equation 5-1 with exponent 2): strength under tension in unit
/// direction `pull`, S = P Q / (P sin^2 + Q cos^2) with P along and Q across the grain.
inline float hankinson(float along, float across, float squared_cosine) {
    return along * across / (along * (1 - squared_cosine) + across * squared_cosine);
}
/// A tip that is pulled open across the grain splits it; pulled along, it has to break fibres.
inline float tip_limit(const GrainLimits& g, Vec3 pull) {
    const float c = dot(g.grain, pull);
    return hankinson(g.tip_along, g.tip_across, c * c);
}

}  // namespace cullet
