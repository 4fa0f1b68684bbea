// From any closed or nearly closed mesh to a solid that breaks: cover and cut (solid cooking note, section 1).
#pragma once
#include "systems/structures/tetrahedra/cook/cut_cells.hpp"
#include "systems/structures/tetrahedra/cook/solid.hpp"

namespace cullet {

struct SolidSettings {
    double cells = 1500;           // wanted, 200 to 20,000
    double most_cells = 20000;     // of a thin body, whose cells are at most four thicknesses wide
    uint32_t element_edges = 4;    // a finite element's edge over that of a cell: 4 in the game, 2 is more accurate
    double jitter = 0.1;           // 0 to 0.15 of an element's edge
    double merge_below = 0.25;     // of a whole cell's volume, 0.1 to 0.4
    double largest_filled = 0.25;  // of the surface may be new, to close holes
    double weld_tolerance = 0;     // as of SurfaceSettings
};

/// What one tetrahedron held before small cells were merged: a break looks up by it whose a tetrahedron's parts are.
struct RawCell {
    uint32_t tetrahedron = 0, cell = 0;
    Vec3d centroid;
};

/// A solid and what it was made from: a break cuts again, with moved points of the lattice.
struct CookedSolid {
    Solid solid;
    ClosedMesh mesh;
    LatticeFaces faces;
    Windings windings;              // of the lattice's points
    std::vector<RawCell> raw;       // by tetrahedron
    /// By tetrahedron that held nothing: the part whose piece has what comes into it when cracks move its corners.
    std::vector<uint32_t> owner_of_empty;
    List<uint32_t> tetrahedron_of;  // where each vertex of the mesh is
    std::string notes;              // for a person: what was closed; or nothing
};

Result<CookedSolid> cook_solid(const Mesh& mesh, const SolidSettings& settings = {});

}  // namespace cullet
