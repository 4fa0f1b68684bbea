// Which side of an open mesh is outside. A closed part says it itself; of an open one the winding that came may be
// either, and what faces a striker hangs on it.
#pragma once
#include "engine/mesh.hpp"
#include "systems/cook/surface.hpp"

namespace cullet {

/// Winds open parts of `mesh`, from which `surface` was prepared, so that their bulging side is outside, or, of nearly
/// flat ones, the side away from the middle of the mesh. What is flat and in the middle stays as it came. Normals that
/// pointed along the winding are turned with it. Returns how many parts were turned: if any, the surface is another.
uint32_t turn_outwards(Mesh& mesh, const Surface& surface);

}  // namespace cullet
