// What births ask of a shell about its fragments (structure_calls.hpp).
#pragma once
#include "systems/structure_calls.hpp"

namespace cullet {

/// Fragments, their rows, their motions, and pieces that wait.
void add_fragment_calls(StructureCalls& calls);

}  // namespace cullet
