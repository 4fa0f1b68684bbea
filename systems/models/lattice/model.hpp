// The model lattice: solids of tetrahedra that break along bonds.
#pragma once
#include "systems/damage_model.hpp"

namespace cullet {

DamageModel lattice_model();

}  // namespace cullet
