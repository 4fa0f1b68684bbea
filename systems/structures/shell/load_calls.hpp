// What loads ask of a shell (structure_calls.hpp).
#pragma once
#include "systems/structure_calls.hpp"

namespace cullet {

void add_load_calls(StructureCalls& calls);

}  // namespace cullet
