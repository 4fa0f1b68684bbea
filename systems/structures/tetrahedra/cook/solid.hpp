// A solid as it is cooked: a lattice of tetrahedra that covers it, cells that are what a tetrahedron holds of it, and
// bonds between them (solid cooking note, sections 1 to 5). Nothing of it is fitted to the surface, and the drawn mesh
// stays as it came.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "engine/math.hpp"

namespace cullet {

/// Corners and the middles of the edges 01, 02, 03, 12, 13, 23.
using TenNodes = std::array<uint32_t, 10>;
/// The symmetric integral of l l^T over solid, l the four barycentric coordinates of the coarse tetrahedron, m3:
/// 00, 01, 02, 03, 11, 12, 13, 22, 23, 33.
using Moments = std::array<double, 10>;

/// Body-centred, jittered, laid over the solid. Body frame, m.
struct CoverLattice {
    double edge = 0;                            // a: of the cubes of fine tetrahedra
    std::vector<Vec3d> points;                  // of fine tetrahedra
    std::vector<std::array<uint32_t, 4>> fine;  // points, of positive volume
    std::vector<uint32_t> coarse_of;            // of each fine one
    std::vector<TenNodes> coarse;               // points where every coarse one is cut into 8 (finite elements of 2a)
    std::vector<std::array<uint32_t, 4>> neighbours;  // fine ones beside the face opposite of each corner; kNone: rim
};

/// One row is one connected part of a tetrahedron and the solid; small ones are merged into a neighbour.
struct SolidCell {
    uint32_t tetrahedron = 0;  // fine: the one with most of it
    double volume = 0;         // m3
    Vec3d centroid;
};
/// What a cell has in one coarse tetrahedron. A merged cell may have parts in two.
struct CellMoments {
    uint32_t cell = 0, coarse = 0;
    Moments moments{};
};
/// One row is the inside part of a face between two cells, of which `a` is the lower.
struct SolidBond {
    uint32_t a = 0, b = 0;
    uint32_t tetrahedron = 0, face = 0;  // fine, and which of its faces (opposite of that corner)
    double area = 0;                     // m2
    Vec3d centroid, normal;              // unit, from a to b
};
/// One row is the part of a drawn triangle that lies in one cell.
struct SurfacePatch {
    uint32_t triangle = 0, cell = 0;
    double area = 0;
    Vec3d centroid;
};

struct Solid {
    CoverLattice lattice;
    std::vector<SolidCell> cells;
    std::vector<CellMoments> moments;            // by cell, then by coarse tetrahedron
    std::vector<SolidBond> bonds;                // by (a, b), then by face
    std::vector<SurfacePatch> patches;           // by triangle
    double volume = 0, area = 0, thickness = 0;  // of the whole; thickness = 2 V / A
};

}  // namespace cullet
