// From a clean mesh to a thick shell that cracks, tears or flows.
#pragma once
#include <memory>

#include "systems/cook/cooking.hpp"
#include "systems/cook/model_contents.hpp"

namespace cullet {

/// Gives the surface thickness, assembles the stiffness and finds from which hit on it cracks. A sentence without the
/// mesh's name refuses it.
Result<std::shared_ptr<Model::Contents>> cook_thick_shell(Cooking& from);

}  // namespace cullet
