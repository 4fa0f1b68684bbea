// Whether a frame made energy: in Checked and Debug builds each one is asked, and one that did is a fault.
#pragma once
#include "engine/rigid_world.hpp"
#include "systems/checks/world_energy.hpp"

namespace cullet {

/// From where the game's blows have been taken to where debris has fallen. Contacts, cracks, sleep, plastic flow and
/// drag take energy; nothing in a frame may add any but what is counted here, which comes from outside or is the price
/// of steps: E_end <= E_start + from_outside + rigid work + tolerance.
struct EnergyBalance {
    MechanicalEnergy start;
    double from_outside = 0;  // DamageCounts.work_from_outside, as it was
    RigidWork rigid;          // as it was
    double gain = 0;          // J, of the last frame, beyond what is counted
    double most_share = 0;    // of the tolerance, of all frames so far,
    double most_gain = 0;     // J, in the same frame,
    uint64_t most_frame = 0;  // which is this one
};

/// What floats, contacts that are not solved to the end, and springs in steps of their own are allowed, J.
double energy_tolerance(const Step& step, const MechanicalEnergy& before, const MechanicalEnergy& after);
/// What frames with awake soft bodies are allowed beyond that, J.
double soft_tolerance(const MechanicalEnergy& before, const MechanicalEnergy& after);

}  // namespace cullet
