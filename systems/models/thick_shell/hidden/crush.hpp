// Struck material crushes. A patch spring is elastic up to the force that its share of the bearing area can take. Then
// it gives way at that force, and what has been crushed hardly pushes back. A purely elastic patch throws a ball of 30
// kg at 10 m/s back from a brick wall at 3.6 m/s, with the plug already out.
//
// Loading: F = k d up to the yield force Y; beyond, F = Y and the crush c = d - Y/k grows. Unloading and loading again
// below Y: F = Y - k_u (c + Y/k - d), never pulling. k_u goes with the crush from k to k/e^2, e the material's
// restitution, which it reaches at c = Y/k (Walton and Braun 1986, with the ramp of Luding 2008). So the restitution of
// a blow falls steadily from 1 at the yield speed. Returning e^2 of the work below the yield as well was tried: it
// moved the wall's thresholds by 45 %.
#pragma once
#include <algorithm>

namespace cullet {

/// One patch spring. Forces in N, lengths in m.
struct PatchSpring {
    float stiffness;          // k, > 0
    float crushed_stiffness;  // k / e^2, >= k
    float yield_force;        // Y, > 0

    float unloading_stiffness(float crush) const {
        const float share = std::min(1.0f, crush * stiffness / yield_force);
        return stiffness + share * (crushed_stiffness - stiffness);
    }
    /// Pushed in by `depth`, negative when apart; `crush` follows.
    float force(float depth, float& crush) const {
        const float at_yield = yield_force / stiffness;
        if (depth - at_yield > crush) crush = depth - at_yield;
        if (!(crush > 0)) return depth > 0 ? stiffness * depth : 0.0f;
        return std::max(0.0f, yield_force - unloading_stiffness(crush) * (crush + at_yield - depth));
    }
    /// What it would give back, J.
    double energy(float depth, float crush) const {
        const double pushed = double{force(depth, crush)};
        return 0.5 * pushed * pushed / double{unloading_stiffness(std::max(0.0f, crush))};
    }
};

}  // namespace cullet
