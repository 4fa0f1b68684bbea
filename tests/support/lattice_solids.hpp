// Solids for tests of the lattice model that need no cutter: convex bodies, given by planes, filled with a body-centred
// lattice whose tetrahedra are clipped by the planes.
#pragma once
#include <vector>

#include "systems/structures/tetrahedra/cook/solid.hpp"

namespace cullet {

/// A place is inside where dot(normal, place) <= offset.
struct BodyPlane {
    Vec3d normal;
    double offset = 0;
};
std::vector<BodyPlane> box_planes(Vec3d half);
/// Upright along z, with so many sides.
std::vector<BodyPlane> column_planes(double radius, double half_height, int sides);
/// As round as points of a Fibonacci spiral make it.
std::vector<BodyPlane> ball_planes(double radius, int sides);

struct LatticeFill {
    double edge = 0;        // a, m
    int elements = 2;       // edge of the finite elements in a: 2 or 4
    double jitter = 0.1;    // of coarse corners, in edges of the elements
    double merge = 0.25;    // cells below this share of a full tetrahedron join a neighbour
    bool is_turned = true;  // the lattice lies askew in the body
};
/// Triangles of the surface count two a plane. `half`: of a box that holds the body.
Solid fill_convex(const std::vector<BodyPlane>& planes, Vec3d half, const LatticeFill& fill);

}  // namespace cullet
