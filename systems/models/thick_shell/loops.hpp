// The inner loops of the thick shell, and what their runs cost.
#pragma once
#include "systems/models.hpp"

namespace cullet {

void register_loops(DamageModel& model);

}  // namespace cullet
