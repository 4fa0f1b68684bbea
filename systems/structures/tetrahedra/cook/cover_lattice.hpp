// The lattice that covers a solid: where cells and finite elements stand (solid cooking note, 4.7).
#pragma once
#include "cullet/result.hpp"
#include "systems/structures/tetrahedra/cook/closed_mesh.hpp"
#include "systems/structures/tetrahedra/cook/solid.hpp"

namespace cullet {

struct CoverSettings {
    double edge = 0;                 // a, m: of the cubes of fine tetrahedra
    uint32_t element_edges = 2;      // a finite element's cube has an edge of 2 a or 4 a
    double jitter = 0.1;             // of a finite element's edge, of its corners
    uint32_t most_coarse = 4000000;  // coarse tetrahedra of the whole box; more are refused
};

/// Tetrahedra that the surface meets, all that it encloses, and those around them. No vertex of a tetrahedron that
/// holds solid is on the rim. Needs no inside test and fits nothing to the surface.
Result<CoverLattice> cover_lattice(const ClosedMesh& mesh, const CoverSettings& settings);

/// Edge a of cubes of which `cells` tetrahedra hold a volume.
double edge_for(double volume, double cells);

/// Fills `neighbours` from `fine`.
void find_neighbours(CoverLattice& lattice);

/// Corners of the face opposite of each corner, counter-clockwise from outside.
inline constexpr uint32_t kFaceCorners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

}  // namespace cullet
