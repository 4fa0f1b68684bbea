// What must hold of the pieces of a hit before they are born (T10, T11 of the thick shell note): nothing, or the first
// flaw in words.
#pragma once
#include <string>

#include "components/state.hpp"

namespace cullet::test {

/// Each live element of task `t`'s shell is in exactly one part, of which no link leads out; parts come in the order of
/// their first elements.
std::string flaw_of_partition(State& state, uint32_t t);

/// Without clamps each part's momenta are those of its vertices, 1e-6 relative, and the energy is not larger; after
/// them the momenta's sum is what it was.
std::string flaw_of_handoff(State& state, uint32_t t);

}  // namespace cullet::test
