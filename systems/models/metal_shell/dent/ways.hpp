// Ways along a metal sheet, over its edges and the ties between sheets.
#pragma once
#include "systems/models/metal_shell/shared/metal_view.hpp"

namespace cullet {

inline constexpr float kNoWay = 1e30f;

/// Fills MetalVertices.way, m: what stands there before, or a neighbour's way and the edge to it, where that is shorter
/// and at most `limit`. So with 0 where it begins and kNoWay elsewhere it is the shortest way from there. Lengths are
/// those of the original shape.
void spread_ways(const MetalView& metal, float limit);

}  // namespace cullet
