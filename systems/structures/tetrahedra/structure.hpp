// Solids as a kind of structure.
#pragma once
#include "systems/slots.hpp"
#include "systems/structure_calls.hpp"

namespace cullet {

SlotList tetrahedra_structure();
const StructureCalls& tetrahedra_calls();

}  // namespace cullet
