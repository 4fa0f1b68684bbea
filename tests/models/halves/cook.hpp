// From a clean mesh to a shell.
#pragma once
#include "systems/cook/cooking.hpp"
#include "systems/cook/model_contents.hpp"

namespace cullet::halves {

Result<std::shared_ptr<Model::Contents>> cook_halves(Cooking& from);

}  // namespace cullet::halves
