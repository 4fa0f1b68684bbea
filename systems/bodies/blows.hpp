// Blows of the game between the call and the end of their task.
#pragma once
#include "components/blows.hpp"
#include "systems/world_data.hpp"

namespace cullet {

inline Explosion explosion_of(const Blows& blows, uint32_t row) {
    return {blows.point[row], blows.radius[row], blows.strength[row]};
}

/// Inverse of the mass that a body sets against a push along a unit normal at a point: 1/m + (r x n) . I^-1 (r x n),
/// body frame, 1/kg. 0 of what does not move by forces.
double inverse_mass_at(const Bodies& bodies, Row<Bodies> body, Vec3d point, Vec3d normal);

/// A dynamic body gets this impulse (N s, body axes) and turning (N m s, about its centre of mass), and wakes. It comes
/// from outside: DamageCounts.impulse_to_static has it with the other sign. What would be faster than kFastest is
/// shortened to it and counted in DamageCounts.clamped.
void push_body(Bodies& bodies, RigidWorld& rigid, DamageCounts& counts, Row<Bodies> body, Vec3d impulse, Vec3d turning);

/// What the blow gives to the body as a rigid one, unless it was given.
void pay_blow(Blows& blows, Bodies& bodies, RigidWorld& rigid, DamageCounts& counts, uint32_t row);
/// All blows of the task.
void pay_blows(Blows& blows, Bodies& bodies, RigidWorld& rigid, DamageCounts& counts, Row<Tasks> task);

/// The task is over: its blows go, after they were paid. A cut that found no room for all of it, or whose pieces found
/// none, waits again, and so does every blow whose task found no rows but may find some later.
void close_blows(Blows& blows, Bodies& bodies, const Tasks& tasks, RigidWorld& rigid, DamageCounts& counts,
                 Row<Tasks> task);

/// A cut of the body that no task has: it goes before hits. What is struck in every frame would never come to it.
bool has_waiting_cut(const Blows& blows, Row<Bodies> body);

bool has_explosion(const Blows& blows, Row<Tasks> task);

/// N s, body axes, that explosions gave to the task's run and that nobody has been paid for; from now on they count as
/// paid.
Vec3d take_explosions(Blows& blows, Row<Tasks> task);

}  // namespace cullet
