// What an explosion does to one body: its impulse by distance and facing (cullet/damage.hpp has the formula).
#pragma once
#include "components/blows.hpp"
#include "components/shell_rows.hpp"

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

/// O(elements of the shell). Elements behind others of the same shell, seen from the centre, get nothing.
ExplosionSums measure_explosion(ShellView shell, const Explosion& explosion, Vec3d about);

/// Gives every free vertex its share, a third of each of its elements': velocity alone. The shell's vertices must have
/// their velocities already.
void kick_vertices(ShellView shell, const Explosion& explosion);

/// The same for an awake soft body, whose velocities run along the world's axes: `turn` takes the body's into them. Its
/// second layer of points begins at row `first_twin` of Twins; kNone: it has one layer.
void kick_points(ShellView shell, uint32_t first_twin, const Explosion& explosion, Quat turn);

/// On a solid ball, along the line from the explosion's centre to the ball's, N s; in 32 rings of equal height.
double impulse_on_ball(double distance, double ball_radius, float reach, float strength);

}  // namespace cullet
