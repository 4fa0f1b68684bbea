// The hidden step of shells that store the pairs of a pair cell once
// (systems/models/thick_shell/stiffness/pair_cells.hpp): as integrate_packs, but what a pair does to its other end goes
// there by a 128-bit add.
#pragma once
#include "systems/models/thick_shell/hidden/integrate_packs.hpp"

namespace cullet {

void integrate_pairs(const HiddenStep& step, uint32_t first_pack, uint32_t pack_count);

}  // namespace cullet
