// The axis along which two overlapping hulls overlap least, by the separating axis theorem: faces of both, and those
// pairs of edges whose arcs on the Gauss sphere cross (Gregorius, The Separating Axis Test between Convex Polyhedra,
// GDC 2013).
#pragma once
#include "engine/bullet/closest_points.hpp"

namespace cullet::bullet {

struct OverlapAxis {
    bool is_found = false;
    Vec3d axis;      // unit, world, from b towards a
    double gap = 0;  // of the cores along it; negative is the overlap
};

/// `rotation_a` and `rotation_b` turn the hulls' local axes into world axes. `before` is the axis that the two last met
/// along, or zero: of thin pieces the least overlap changes sides once they are half through each other, so that an
/// axis counts as deeper by `turning` (m) (1 - cosine to `before`). Seams between pieces of one body offer no axis. Of
/// equal overlaps the first in the order faces of b, faces of a, edges. A one-sided hull offers its front face alone.
/// Two hulls without faces give nothing.
OverlapAxis overlap_axis(const Hull& a, const Mat3& rotation_a, const Hull& b, const Mat3& rotation_b, Vec3d before,
                         double turning);

}  // namespace cullet::bullet
