// Sheet metal: rigid between impacts, dented by each of them, in folds and creases that sub-shells carry.
#pragma once
#include "systems/damage_model.hpp"

namespace cullet {

DamageModel metal_shell_model();

}  // namespace cullet
