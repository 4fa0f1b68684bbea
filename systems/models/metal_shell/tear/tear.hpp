// A dent that goes on beyond what the sheet can be stretched to: it tears (metal shell note, section 14).
#pragma once
#include "systems/bodies/pin_boxes.hpp"
#include "systems/models/metal_shell/tear/tear_star.hpp"

namespace cullet {

/// What became of it.
struct Tear {
    uint32_t cut_edges = 0;
    bool is_full = false;     // there was no room for all: what was cut stays cut
    bool is_through = false;  // the striker goes on through the hole
    double work = 0;          // J
};

/// Of a shell that was dented (bake_dent): cracks run from the dent's middle, petals or the lips of a slit bend out of
/// the striker's way; what is hit hard enough has its middle punched out. Rows of metal follow. `may_pass`: what
/// strikes can go on through it; else there is a star at most.
Tear tear_sheet(const MetalView& metal, const Dent& dent, const PinBoxes& pin_boxes, bool may_pass);

}  // namespace cullet
