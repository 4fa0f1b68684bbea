// From the momenta of fragments to their motions, whatever they are made of (thick shell note 6.6).
#pragma once
#include "engine/scratch.hpp"
#include "systems/births/break.hpp"

namespace cullet {

struct HandoffReport {
    Row<Fragments> largest;
    uint32_t speed_clamps = 0, spin_clamps = 0;
    Vec3d momentum_before;        // N s, of the hidden state
    Vec3d momentum_after;         // of the moving parts; before = after + support, to rounding
    Vec3d support_momentum;       // what pinned parts took into the ground, and cut-offs when the largest is static
    Vec3d free_support;           // of that, before the clamps
    Vec3d spin_clamp_loss;        // angular momentum that spin clamps took, N m s
    double energy_hidden = 0;     // J
    double energy_crushed = 0;    // of the rigid motions, at cracks whose faces were on their way into each other
    double energy_unclamped = 0;  // of the rigid motions before the clamps, <= hidden
    double energy_after = 0;
};

/// What the fragments' structure summed (StructureCalls::sum_momenta) becomes their motions: each turns with the
/// inertia of its points, and what holds a pin stands. Hidden runs let crack faces pass through each other: fragments
/// that would go on to do so are stopped where they touch (stop_approach), before the clamps. Clamps: a fragment's
/// speed relative to the body's motion before the hit (V + w x r at its centre) is at most twice the impact speed. What
/// is cut off goes to the largest, which is not clamped. Its spin relative to the body's before is at most 2
/// impact_speed / radius. It is relative, or a body that flew spinning would lose its spin on breaking. Where the
/// largest would get more energy by that than there was, all clamps go as far as energy allows and no farther. Changes
/// nothing but rows of these fragments and of their touches.
HandoffReport settle_momenta(Fragments& fragments, Rows<Fragments> of, Touches& touches, const HandoffStart& start,
                             ScratchMemory& scratch);

}  // namespace cullet
