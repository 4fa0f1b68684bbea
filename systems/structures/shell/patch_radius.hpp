// How far around the point of a blow the surface takes it: r_c of the thick shell note, section 6.3.
#pragma once
#include <algorithm>

#include "components/shells.hpp"

namespace cullet {

/// Of a ball's radius: what it touches itself, and the least that a patch reaches.
inline constexpr double kFootprint = 0.35;

/// m. What opens a task, merges pushes and lays the patch takes the same. Thin joined walls have a depth that is more
/// than their thickness.
inline float patch_radius(const Shells& shells, Row<Shells> shell, float striker_radius) {
    const double depth = std::max(shells.thickness[shell], shells.depth_floor[shell]);
    return static_cast<float>(std::max({3 * depth, 1.3 * shells.mean_edge[shell], kFootprint * striker_radius}));
}

}  // namespace cullet
