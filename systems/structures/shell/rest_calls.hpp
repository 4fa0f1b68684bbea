// What births ask of a shell about its own rows, and about what stays of it (structure_calls.hpp).
#pragma once
#include "systems/structure_calls.hpp"

namespace cullet {

void add_rest_calls(StructureCalls& calls);

}  // namespace cullet
