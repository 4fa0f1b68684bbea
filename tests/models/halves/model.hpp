// The least damage model that there can be: a shell that falls in two where it is hit. It has no tables of its own, and
// lives in tests alone. What a model needs stands in this folder, and nowhere else.
#pragma once
#include "systems/damage_model.hpp"

namespace cullet::halves {

DamageModel halves_model();

}  // namespace cullet::halves
