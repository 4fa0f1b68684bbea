// What an explosion does to a body, whatever that is made of (cullet/damage.hpp has the formula).
#pragma once
#include "engine/math.hpp"

namespace cullet {

/// What it gives to a body, body axes.
struct ExplosionSums {
    Vec3d impulse;      // N s
    Vec3d turning;      // N m s, about the point asked for
    Vec3d place;        // m, of the impulse: the mean of the elements' places by the size of their impulses
    double size = 0;    // N s, of all pieces of it without regard to direction
    double energy = 0;  // J, that its elements would have if each were alone
    float speed = 0;    // m/s, of the element that would be thrown fastest if it were alone
};

/// On a solid ball, along the line from the explosion's centre to the ball's, N s; in 32 rings of equal height.
double impulse_on_ball(double distance, double ball_radius, float reach, float strength);

}  // namespace cullet
