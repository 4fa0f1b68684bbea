// How one fragment moves, as a value.
#pragma once
#include "components/fragments.hpp"

namespace cullet {

inline constexpr double kMostRelativeSpeed = 2;  // times the impact speed, for shards and for their rims' spin

/// Along the body's axes.
struct PartMotion {
    double mass = 0;  // kg
    Vec3d centre;     // m
    Sym3d inertia;    // about the centre, kg m2
    double radius = 0;
    Vec3d momentum, velocity, spin;
    double hidden_energy = 0;
    bool is_static = false, is_speed_clamped = false, is_spin_clamped = false;
};

inline PartMotion motion_of(const Fragments& f, uint32_t row) {
    return {f.moving_mass[row],
            f.centre[row],
            f.inertia[row],
            f.radius[row],
            f.momentum[row],
            f.velocity[row],
            f.spin[row],
            f.hidden_energy[row],
            f.has_pins[row] != 0,
            f.is_speed_clamped[row] != 0,
            f.is_spin_clamped[row] != 0};
}

/// An inertia that has an inverse in double: not of a part that is all too thin.
inline bool can_turn(const Sym3d& inertia) {
    const double scale = trace(inertia);
    return determinant(inertia) > 1e-12 * scale * scale * scale;
}

}  // namespace cullet
