// What loads ask of a solid (structure_calls.hpp).
#pragma once
#include "systems/structure_calls.hpp"

namespace cullet {

void add_solid_load_calls(StructureCalls& calls);

}  // namespace cullet
