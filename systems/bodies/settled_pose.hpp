// The rigid world may put a body down elsewhere than it was told: what a sheet of static triangles cuts comes to the
// side of its centre at once.
#pragma once
#include "components/bodies.hpp"
#include "engine/rigid_world.hpp"

namespace cullet {

/// Takes over where the body was put, and draws nothing between the two places. True when it is another place. A pose
/// that went into the rigid world and came back is the same to rounding; it stays as it was said.
bool take_settled_pose(Bodies& bodies, const RigidWorld& rigid, Row<Bodies> body);

}  // namespace cullet
