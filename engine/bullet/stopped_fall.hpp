// What gravity gives a body that was stopped on its way through a step, or led along what it glanced over.
#pragma once
#include <LinearMath/btVector3.h>

#include "engine/math.hpp"

namespace cullet::bullet {

/// The velocity of a body that went only `fraction` of a step with `velocity` and `glance`, m/s, to which gravity gave
/// its part of the whole one. What it did not fall it has not earned: from m v^2 / 2 of its fall goes m g times that
/// height. What rises and was stopped lost more than it climbed, and gets nothing back; what does not fall any more
/// lies on something, which carried it.
btVector3 velocity_of_stopped(const btVector3& velocity, const btVector3& gravity, float fraction, float dt,
                              Vec3 glance = {});

}  // namespace cullet::bullet
