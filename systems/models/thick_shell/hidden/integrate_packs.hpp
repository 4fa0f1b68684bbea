// One step of the hidden brittle run (thick shell note, section 10), one fused pass over packs of 8 vertices:
//
//     f_i = sum_j K_ij (w_j - w_i)        w = u + beta v at the step's start
//     v += dt f / m,  u += dt v,  next w = u + beta v
//
// The difference form makes rigid travel free of force to the last bit. Any pack may run before any other, on any
// thread: a pack reads side `side` of the probe and writes its own rows of v, u and the other side.
#pragma once
#include "components/shell_rows.hpp"

namespace cullet {

struct HiddenStep {
    const uint32_t* first_block;  // of the shell's packs
    const uint16_t* block_count;
    const uint32_t* first_link;
    const uint16_t* link_count;
    const StiffnessBlock* blocks;
    const StiffnessLink* links;
    const float* inverse_mass;  // of the shell's first vertex, and so on
    float* u[3];
    float* v[3];
    const Float4* probe;
    Float4* next_probe;
    float dt, beta;  // s
    uint32_t pack_count;
    bool has_pair_cells = false;  // pairs inside a pair cell are stored once

    /// `side`: parity of the step, the side of the probe that is read.
    HiddenStep() = default;
    HiddenStep(ShellView shell, float time_step, float damping_time, uint32_t side);
};

/// With pair cells packs come by whole cells: `first_pack` is a multiple of kPairCellPacks, and so is `pack_count`
/// unless the last pack is among them.
void integrate_packs(const HiddenStep& step, uint32_t first_pack, uint32_t pack_count);

}  // namespace cullet
