// How thick a wall came out.
#pragma once
#include "systems/structures/shell/cook/extrude.hpp"

namespace cullet {

/// Mean over the area of the distance between the inner points and the surface, and the 5th percentile of it, both over
/// thickness.
struct TrueWall {
    double mean = 0, low = 0, least = 0;
};
TrueWall measure_true_wall(const Surface& surface, const Extrusion& extrusion, double thickness);

}  // namespace cullet
