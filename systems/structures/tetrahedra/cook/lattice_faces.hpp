// Faces and edges of a lattice of tetrahedra, each numbered once: what a cut names its points by.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "systems/structures/tetrahedra/cook/solid.hpp"

namespace cullet {

struct LatticeFace {
    std::array<uint32_t, 3> corner;       // counter-clockwise from outside of the first tetrahedron
    std::array<uint32_t, 2> tetrahedron;  // the second sees it from the other side; kNone: rim
    /// Edge k runs between corner k and corner k + 1: its number, and whether that is the way from its lower end.
    std::array<uint32_t, 3> edge;
    std::array<bool, 3> is_forward;
    uint32_t place = 0;  // in the first tetrahedron: opposite of that corner
};

struct LatticeFaces {
    std::vector<LatticeFace> faces;
    std::vector<std::array<uint32_t, 4>> of;     // a tetrahedron, opposite of each corner
    std::vector<std::array<uint32_t, 2>> edges;  // the lower point first
};

/// Faces in the order of their first tetrahedron; the same lattice gives the same numbers wherever its points are.
LatticeFaces number_faces(const CoverLattice& lattice);

}  // namespace cullet
