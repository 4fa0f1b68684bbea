// A cooked solid as rows, and back.
#pragma once
#include "components/solid_rows.hpp"
#include "engine/mesh.hpp"
#include "systems/structures/tetrahedra/cook/cook_solid.hpp"

namespace cullet {

/// A whole one of one user, without hulls; kNone: some table is full. `mesh`: what it was cooked from, with the
/// normals, uvs and materials of its triangles. What closes holes has flat normals.
Row<Structures> write_solid(SolidRows rows, const CookedSolid& cooked, const Mesh& mesh, const char** full);

/// All but what is told to a person; what follows from other rows is made again.
CookedSolid read_solid(Read<SolidRows> rows, Row<CookedSolids> row);

}  // namespace cullet
