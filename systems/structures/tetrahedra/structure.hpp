// Solids as a kind of structure.
#pragma once
#include "systems/structure_calls.hpp"

namespace cullet {

/// Rows, mass and drawing. Those of fragments are not written yet: nothing may break a solid before they are.
const StructureCalls& tetrahedra_calls();

}  // namespace cullet
