// From the world to working positions and back.
#pragma once
#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {

/// A rigid body's motion: of its body frame, and the velocity of its centre of mass.
struct RigidMotion {
    Pose pose;      // world
    Vec3 velocity;  // of the centre of the vertices' masses, m/s
    Vec3 spin;      // rad/s
};

/// Puts all points where the body's shape stands in the world: its rest shape and Vertices.displacement about it,
/// moving as the rigid body does; pinned points stand still. The working frame has its origin at the body's, so that
/// floats hold small numbers far from the world's. No spring is closing; steps is 0.
void start_springs(const SpringView& view, const RigidMotion& motion);
/// The pose that fits the points best, by least squares by mass of both layers' middles. Points on one line or in one
/// place leave it open, and get some turn that fits them. The velocity and spin have the points' momentum and angular
/// momentum; the spin about a line that all points lie on is 0. What remains is the shape: Vertices.displacement, in
/// the body frame, of the outer layer, and Twins.through of the inner one. Vertices.velocity is cleared.
RigidMotion stop_springs(const SpringView& view);
/// From the outer point to the inner one, body frame, as the springs left it, or as they were cooked. Two layers only.
Vec3 through_at_rest(const SpringView& view, uint32_t vertex);

/// Of the points as they are now, in the working frame about its origin.
struct SpringMotion {
    double mass = 0;          // kg
    Vec3d centre;             // m
    Vec3d momentum, angular;  // N s; N m s about the centre
    double kinetic = 0;       // J
};
SpringMotion motion_of(const SpringView& view);

/// Energy of all springs (B3, B4, B5), from lengths as they are now: J.
double spring_energy(const SpringView& view);
/// What makes up, with the kinetic energy as it is now, the energy that the steps keep: k e e' / 2 of lengths as they
/// are now and were a step ago. Of spring_energy() a stiff vertex, whose step is near its bound, shows several times
/// that in one step and a fraction of it in the next: places are half a step ahead of velocities.
double kept_spring_energy(const SpringView& view);

}  // namespace cullet
