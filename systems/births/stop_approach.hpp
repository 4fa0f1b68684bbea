// Bodies that touch at rough faces do not go on into each other.
#pragma once
#include <span>

#include "components/fragments.hpp"

namespace cullet {

/// What moves, or nothing does: without inverse mass.
struct Touching {
    Vec3d centre, velocity, spin;
    double inverse_mass = 0;  // 1/kg
    Sym3d inverse_inertia;    // about the centre
};

/// Takes away the speed at which the two of each touch approach there. Makes them open by a share of what they slide,
/// and as fast as keeps them open while they turn on a little. The impulses never pull, and are on one line, equal and
/// opposite. They come by Gauss-Seidel sweeps in the order of the touches. Momentum and angular momentum are kept, and
/// what already parts so is left alone. Each impulse against an approach or a slide lowers the energy; those that open
/// for what turns may raise it, so who needs it bounded has to look. Sweeps end when nothing lacks more than a
/// thousandth of `speed`, or after 80; most look only at touches that have needed an impulse. `bodies` stand for the
/// fragments from row `first` on.
void stop_approach(std::span<Touching> bodies, uint32_t first, Touches& touches, Rows<Touches> of, double speed);

}  // namespace cullet
