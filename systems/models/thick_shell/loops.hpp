// The inner loops of the thick shell, and what their runs cost.
#pragma once
#include "systems/damage_model.hpp"

namespace cullet {

void register_loops(DamageModel& model);

}  // namespace cullet
