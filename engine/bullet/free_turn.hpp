// How a body turns while nothing touches it.
#pragma once
#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace cullet::bullet {

/// The spin that the body has a step later, by Euler's equations I w' = I w x w in its own axes, which are those of its
/// moments of inertia. Kinetic energy is kept to rounding, whatever the step: a shard that leaves a break at 300 rad/s
/// turns by five radians in one, where Bullet's implicit step (one of Newton's) takes most of its energy. The pose is
/// to be moved with the new spin.
void turn_freely(btRigidBody& body, float dt);

}  // namespace cullet::bullet
