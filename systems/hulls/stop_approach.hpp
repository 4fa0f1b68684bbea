// Bodies that touch at rough faces do not go on into each other.
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
    uint32_t a = 0, b = 0;  // of the touching
    Vec3d point, normal;    // unit, from b towards a
    double reach = 0;       // m, of this part of the crack to both sides of the point
    Vec3d impulse;          // N s, on a, and the opposite on b: what was needed
    Vec3d arm_a, arm_b;     // from the centres: scratch
    bool is_used = false;   // scratch
};

/// Takes away the speed at which the two of each touch approach there, and makes them open by a share of what they
/// slide, and as fast as keeps them open while they turn on a little: impulses that never pull, on one line, equal and
/// opposite, by Gauss-Seidel sweeps in the order of the touches. Momentum and angular momentum are kept, and what
/// already parts so is left alone. Each impulse against an approach or a slide lowers the energy; those that open for
/// what turns may raise it, so who needs it bounded has to look. Sweeps end when nothing lacks more than a thousandth
/// of `speed`, or after 80; most look only at touches that have needed an impulse.
void stop_approach(std::span<Touching> bodies, std::span<Touch> touches, double speed);

}  // namespace cullet
