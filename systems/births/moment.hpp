// What turns motions along a body's axes into the world's.
#pragma once
#include "systems/births/break.hpp"
#include "systems/births/part_motion.hpp"

namespace cullet {

/// `change` is the body's motion now less the hidden motion that stands for it, both in body axes about the pieces'
/// common centre. On time that is its motion at the touch: zero, unless something pushed the body while it was held.
/// Late it is the hidden state's mean, because the rigid solver has passed the blow's impulse already; a pinned body
/// has no motion to be relative to.
struct Moment {
    Pose pose;
    Vec3d centre;  // of the pieces, body frame
    Vec3d velocity_change, spin_change;
    bool is_late;
};

/// Of a break that a task brought.
Moment moment_of(const BodyRows& state, const Fragments& fragments, const Break& of);

Motion world_motion(const Moment& moment, const PartMotion& part);

}  // namespace cullet
