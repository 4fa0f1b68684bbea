// Ways along a metal sheet, over its edges and the ties between sheets.
#pragma once
#include "systems/models/metal_shell/shared/metal_view.hpp"

namespace cullet {

inline constexpr float kNoWay = 1e30f;

/// Fills MetalVertices.way: the shortest way from any vertex whose way is 0 to each that is at most `limit` away, m;
/// elsewhere it is kNoWay. Before: 0 or kNoWay. Lengths are those of the original shape.
void spread_ways(const MetalView& metal, float limit);

}  // namespace cullet
