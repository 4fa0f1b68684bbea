// What an explosion does to a shell: its impulse by distance and facing (cullet/damage.hpp has the formula).
#pragma once
#include "components/blows.hpp"
#include "components/shell_rows.hpp"
#include "systems/bodies/explosion.hpp"

namespace cullet {

/// O(elements of the shell). Elements behind others of the same shell, seen from the centre, get nothing.
ExplosionSums measure_explosion(ShellView shell, const Explosion& explosion, Vec3d about);

/// Gives every free vertex its share, a third of each of its elements': velocity alone. The shell's vertices must have
/// their velocities already.
void kick_vertices(ShellView shell, const Explosion& explosion);

/// The same for an awake soft body, whose velocities run along the world's axes: `turn` takes the body's into them. Its
/// second layer of points begins at row `first_twin` of Twins; kNone: it has one layer.
void kick_points(ShellView shell, uint32_t first_twin, const Explosion& explosion, Quat turn);

}  // namespace cullet
