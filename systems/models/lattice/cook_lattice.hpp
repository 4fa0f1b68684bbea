// Cooking for the model lattice: a closed mesh becomes a solid of cells and bonds, with convex pieces to collide with.
#pragma once
#include "systems/cook/cooking.hpp"
#include "systems/cook/model_contents.hpp"

namespace cullet::lattice {

Result<std::shared_ptr<Model::Contents>> cook_lattice(Cooking& from);

}  // namespace cullet::lattice
