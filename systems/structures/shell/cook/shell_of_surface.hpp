// The rows of a surface that was given thickness.
#pragma once
#include "systems/cook/cooking.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/structures/shell/cook/extrude.hpp"

namespace cullet {

/// A model with the shell of the surface, of the cooking's material, and with the mesh's attributes found again. What a
/// damage model keeps of it is not filled in. `surface` was prepared from from.fine.
Result<std::shared_ptr<Model::Contents>> shell_of_surface(const Cooking& from, const Surface& surface,
                                                          const Extrusion& extrusion);

}  // namespace cullet
