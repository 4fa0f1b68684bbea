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

/// Shortens v so that it is within `most`. True: it was not.
inline bool shorten(Vec3& v, float most) {
    const float largest = std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
    if (!(largest > most)) return false;
    v = {most * (v.x / largest), most * (v.y / largest), most * (v.z / largest)};
    return true;
}

}  // namespace cullet
