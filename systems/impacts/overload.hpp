// What presses on a body, against what it bears.
#pragma once
#include <span>

#include "engine/rigid_world.hpp"
#include "systems/impacts/loaded_body.hpp"

namespace cullet {

/// One contact of a body as a load.
struct BodyLoad {
    Vec3d place;               // from the centre of mass, body axes, m
    Vec3d push;                // unit, body axes: the way the body is pushed
    double force = 0;          // N, that the last solve passed, and what it would have taken to stop who pushes
    double bears = 0;          // N, that the one who touches can set against a push towards it
    Vec3d velocity, spin;      // m/s at the centre of mass and rad/s, body axes: of who stands, or stands behind
    double driven_speed = 0;   // m/s, of that motion along `push` at `place`
    double depth = 0;          // m, that who touches lies in the body
    double closing = 0;        // m/s, at which it goes on into the body: what the solver could not hold
    double spread = 1;         // share of the force that one place has to bear
    bool stands = false;       // it yields to no force: static, kinematic or held
    bool is_backed = false;    // it stands, or what stands is behind it, seen from the body
    bool is_squeezed = false;  // it is held between others, and moves as they do
    bool is_laid = false;      // it goes straight through the body into what is backed there
    Row<Bodies> toucher;
    uint32_t contact = 0;  // of RigidWorld::loads()
};
inline constexpr double kBearsAll = 1e30;  // N
/// From opposite sides: within 37 degrees of it.
inline bool are_opposite(Vec3d push, Vec3d other) {
    return dot(push, other) < -0.8;
}

double sum_of(std::span<const BodyLoad> loads);  // N, of the forces

/// A load along an axis: m from the centre of mass, N.
struct AxisForce {
    double at, force;
};
/// For as many loads again.
struct OverloadRoom {
    std::span<BodyLoad> loads;
    std::span<AxisForce> forces;
};

struct Overload {
    double share = 0;          // of what the body bears; more than 1 breaks it
    double load = 0;           // N, that squeeze it
    uint32_t contact = 0;      // of RigidWorld::loads(), where it is worst
    bool is_driven = false;    // two that do not yield close on it: no force is enough for long
    bool is_between = false;   // driven, and all that close on it touch it themselves
    double driven_speed = 0;   // m/s, of the fastest that closes on it
    double falling_speed = 0;  // m/s, at which what is not driven goes on into it where it is worst
    double sunk = 0;           // m, that two who do not make way for it lie in it together, from opposite sides
    // Where it would come apart, body frame and axes: across the bar where the moment is largest, or along the push
    // that squeezes it.
    Vec3d section, section_normal;
};

/// N that one place of the body bears for long: less once it has cracks.
double force_borne(const LoadedBody& of);
/// m, see Overload.
double sunk_into(const LoadedBody& of, std::span<const BodyLoad> loads);

/// The worst of these:
/// - Squeezed: along each push, the forces that push that way, as far as the others bear them, over first_crack_force.
/// - Bent: the moment of the loads in sections across its principal axes, over strength times section modulus, W = V/L
///   <x^2> / c (exact for bars, flat sheets and tubes: b h^2 / 6, pi R^2 h). What the loads leave over accelerates it
///   evenly. Pins bear like a beam's supports, the nearest to both sides of the load.
/// - Driven: those that do not yield close on it, from opposite sides or so that it has no way out, and touch it or
///   press on it through others.
/// Sunk into, whatever the solver says, by two of them: who is many times as heavy counts as one that does not make
/// way.
/// A load over somebody who bears the body just there bends nothing, and squeezes by its pressure where it lies flat.
/// `weight`: N, body axes. Where the loads are not in balance as they were solved, those that are backed get what
/// balances the others.
Overload overload_of(const LoadedBody& of, const RigidWorld& rigid, std::span<BodyLoad> loads, Vec3d weight,
                     const OverloadRoom& room);

}  // namespace cullet
