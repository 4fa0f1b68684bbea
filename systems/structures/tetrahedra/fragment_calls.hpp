// What births ask of a solid about its fragments, and about what stays of it (structure_calls.hpp).
#pragma once
#include "systems/structure_calls.hpp"

namespace cullet {

void add_solid_fragment_calls(StructureCalls& calls);

}  // namespace cullet
