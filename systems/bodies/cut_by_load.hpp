// What is loaded beyond its strength, and no blow would break as a load does, comes apart along one surface: what is
// alike, whatever the body is made of.
#pragma once
#include <algorithm>

#include "components/blows.hpp"
#include "engine/math.hpp"

namespace cullet {

/// Where a load parts a body, body frame and axes.
struct LoadedSection {
    Vec3 place, normal;
    uint64_t seed = 0;  // the same makes the same surface
};

/// How far the body goes along a direction, from the frame's origin, m.
struct SectionExtent {
    float low = 1e30f, high = -1e30f;
    float size() const { return high - low; }
    void add(float at) { low = std::min(low, at), high = std::max(high, at); }
};

/// Of the body, along the normal, that is left on either side.
inline constexpr float kKeptOfCut = 0.1f;
/// The place nearest to `at` that leaves so much.
inline float kept_between(const SectionExtent& along, float at) {
    return std::clamp(at, along.low + kKeptOfCut * along.size(), along.high - kKeptOfCut * along.size());
}

/// Half of the table is left to what a step writes of the game's blows.
inline bool has_row_for_cut(const Blows& blows) {
    return blows.size() < blows.limit() / 2;
}
/// A row of a cut of the body, which nobody asks the game about; kNone: there is none.
inline uint32_t append_cut(Blows& blows, Row<Bodies> body) {
    const uint32_t row = blows.append(1);
    if (row == kNone) return kNone;
    blows.clear_rows(row, 1);
    blows.kind[row] = static_cast<uint8_t>(BlowKind::Cut);
    blows.body[row] = body;
    blows.task[row] = kNone;
    blows.is_taken[row] = 1;
    return row;
}

}  // namespace cullet
