// What blows and drawing ask of a shell about its surface (structure_calls.hpp).
#pragma once
#include "systems/structure_calls.hpp"

namespace cullet {

void add_surface_calls(StructureCalls& calls);

}  // namespace cullet
