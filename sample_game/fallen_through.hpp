// Whether a body lies below what should have borne it.
#pragma once
#include <span>

#include "sample_game/solid.hpp"

namespace cullet {

/// On the vertical line through the middle of the body's box: something that never moves is above all of the body, and
/// nothing that never moves bears it from beneath. So it fell through the one, or is stuck in it. What went over an
/// edge of a floor, or down a slope's end, has nothing above it and is not meant; nor is what lies under a table, on
/// the floor. What fell through and drifted out from beneath since is not seen. O(triangles of what never moves).
bool has_fallen_through(const DrawnSolid& body, std::span<const DrawnSolid> never_moving);

}  // namespace cullet
