// A solid with all that a break of it needs: nothing of this changes while it breaks.
#pragma once
#include "systems/models/lattice/cook/crack_field.hpp"
#include "systems/models/lattice/cook/crack_paths.hpp"
#include "systems/models/lattice/cook/solid_elements.hpp"
#include "systems/structures/tetrahedra/cook/closed_mesh.hpp"

namespace cullet {

struct BreakableSolid {
    Solid solid;
    SolidElements elements;
    CrackPaths paths;
    CrackField field;
    /// Of each cell: of the material's tensile strength. Mean 1.
    std::vector<float> strength;
    /// Of each cell: cells that hang together over bonds have one number. Loose parts are pieces from the start.
    std::vector<uint32_t> part;
    uint32_t part_count = 0;
    /// Of each patch: unit, outward. Explosions alone ask for them (give_normals).
    std::vector<Vec3d> patch_normals;
};

/// Strengths are 1.
BreakableSolid make_breakable(Solid solid);

void give_normals(BreakableSolid& body, const ClosedMesh& mesh);

/// Weibull: large cells are weaker, and chance has its part. `modulus`: 6 for glass, 10 for ceramics and stone. The
/// same seed gives the same strengths.
void scatter_strength(BreakableSolid& body, double modulus, uint64_t seed);

}  // namespace cullet
