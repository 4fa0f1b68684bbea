// From a clean mesh to a metal shell.
#pragma once
#include <memory>

#include "systems/cook/cooking.hpp"
#include "systems/cook/model_contents.hpp"

namespace cullet::metal_shell {

/// Refuses materials that do not yield.
Result<std::shared_ptr<Model::Contents>> cook_metal_shell(Cooking& from);
float edge_share(const CookSettings& settings);

}  // namespace cullet::metal_shell
