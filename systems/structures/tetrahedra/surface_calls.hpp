// What blows and drawing ask of a solid about its surface (structure_calls.hpp).
#pragma once
#include "systems/structure_calls.hpp"

namespace cullet {

void add_solid_surface_calls(StructureCalls& calls);

}  // namespace cullet
