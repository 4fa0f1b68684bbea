// Bodies that touch do not go on into each other.
#pragma once
#include <span>

#include "engine/math.hpp"

namespace cullet {

/// What moves, or nothing does: without inverse mass.
struct Touching {
    Vec3d centre, velocity, spin;
    double inverse_mass = 0;  // 1/kg
    Sym3d inverse_inertia;    // about the centre
};

/// A point that two have in common. All in the same axes.
struct Touch {
    uint32_t a = 0, b = 0;               // of the touching
    Vec3d point, normal;                 // unit, from b towards a
    double impulse = 0;                  // N s, along it on a and against it on b: what was needed
    Vec3d arm_a, arm_b, turn_a, turn_b;  // from the centres, and I^-1 (arm x normal): scratch
    double stiffness = 0;                // N s for a metre a second: scratch
};

/// Takes away the speed at which the two of each touch approach there: impulses without friction or restitution, equal
/// and opposite, that never pull, by Gauss-Seidel sweeps in the order of the touches. Momentum and angular momentum are
/// kept, what parts already is left alone, and each impulse lowers the energy. Sweeps end when nothing closes faster
/// than a thousandth of `speed`, or after 80; three of four look only at touches that have needed an impulse.
void stop_approach(std::span<Touching> bodies, std::span<Touch> touches, double speed);

}  // namespace cullet
