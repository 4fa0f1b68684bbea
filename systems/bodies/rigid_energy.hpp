// Energy of bodies as the rigid world moves them.
#pragma once
#include "components/bodies.hpp"
#include "engine/rigid_world.hpp"

namespace cullet {

/// m v^2/2 + w . I w/2, J; 0 for what does not move by itself.
double rigid_energy(const Bodies& bodies, Row<Bodies> body);
/// The same, if it moved so (world axes).
double rigid_energy(const Bodies& bodies, Row<Bodies> body, const Motion& motion);

}  // namespace cullet
