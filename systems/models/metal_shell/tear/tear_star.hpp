// How a sheet tears where something comes through: cracks run out from the middle, and what lies between two of them is
// a petal that bends along a line from tip to tip.
#pragma once
#include "systems/models/metal_shell/dent/dent.hpp"

namespace cullet {

inline constexpr uint32_t kMostPetals = 6;

/// A direction from the star's axis, in the plane across it, m.
struct Across {
    double x = 0, y = 0;
};
inline double dot(Across a, Across b) {
    return a.x * b.x + a.y * b.y;
}

/// Petal i lies between arms i and i + 1.
struct TearStar {
    Vec3d middle, push;  // m; unit: the way the striker goes
    Vec3d x, y;          // unit, across
    uint32_t arms = 0;   // two: a slit
    Across tip[kMostPetals];
    double length = 0;     // m, of the longest arm
    double plug = 0;       // m, radius of what is punched out; 0: nothing
    double bend = 0;       // m: radius in which petals bend
    double most_turn = 0;  // rad, from the plane across; petals differ somewhat
    double gap = 0;        // m, of a slit at its middle, to each side
    double work = 0;       // J
    uint32_t seed = 0;     // of what differs from petal to petal
    bool is_through = false;

    Across across(Vec3d place) const {
        const Vec3d from = place - middle;
        return {cullet::dot(from, x), cullet::dot(from, y)};
    }
};

/// For a dent that is to tear. Nothing is to be torn: no arms. `may_pass`: what strikes can go through it.
TearStar plan_star(const MetalView& metal, const Dent& dent, bool may_pass);
/// In [0, 1), from a number and a seed.
double scatter(uint32_t seed, uint32_t number);

}  // namespace cullet
