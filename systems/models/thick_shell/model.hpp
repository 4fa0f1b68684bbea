// Hollow things that crack, tear or flow (thick shell note).
#pragma once
#include "systems/damage_model.hpp"

namespace cullet {

DamageModel thick_shell_model();

}  // namespace cullet
