// The bending moments of loads in a body's sections.
#pragma once
#include <span>

#include "systems/impacts/loaded_body.hpp"
#include "systems/impacts/overload.hpp"
#include "systems/impacts/underlay.hpp"

namespace cullet {

/// At least so much bends the body too far, whatever lies under it, N.
double least_bending_force(const LoadedBody& of);

/// Raises `worst` to the share that the largest moment has of what its section bears. Free bodies: sections at loads
/// and where the shear force is zero, between which their own weight bends them most. `under`: sections that would sag
/// onto somebody who lies there bear any moment. `forces`: room for one a load.
void bend(const LoadedBody& of, std::span<const BodyLoad> loads, std::span<AxisForce> forces, const Underlay* under,
          Overload& worst);

}  // namespace cullet
