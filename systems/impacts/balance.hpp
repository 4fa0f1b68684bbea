// What those bear that something stands behind, when nothing is to move.
#pragma once
#include <span>

#include "systems/impacts/overload.hpp"

namespace cullet {

/// Gives all backed loads the force that holds `weight` (N, body axes) and the other loads in balance: at least none,
/// no friction. False, when nothing does: the body is on its way. `reach` m from the centre turns moments into forces.
/// An iterative solver lacks what it takes to carry tonnes through some kilograms, and spreads its lack over frames; by
/// this what lies on a body is its load from the first frame on, and a landing on supports is none.
bool balance(std::span<BodyLoad> loads, Vec3d weight, double reach);

}  // namespace cullet
