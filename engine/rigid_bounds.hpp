// How far and how fast a body may be.
#pragma once
#include <cmath>

#include "engine/math.hpp"

namespace cullet {

// m, m/s or rad/s, kg. Farther and faster, floats of the rigid solver run over when squared.
inline constexpr float kFarthest = 1e6f, kFastest = 1e5f, kHeaviest = 1e12f;

/// False for what is no number.
inline bool is_within(Vec3 v, float most) {
    return std::fabs(v.x) <= most && std::fabs(v.y) <= most && std::fabs(v.z) <= most;
}

}  // namespace cullet
