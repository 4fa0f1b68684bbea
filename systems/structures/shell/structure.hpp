// Vertices, elements and hinges: what thick shells are made of, and sheet metal.
#pragma once
#include "systems/slots.hpp"
#include "systems/structure_calls.hpp"

namespace cullet {

SlotList shell_structure();
const StructureCalls& shell_calls();

}  // namespace cullet
