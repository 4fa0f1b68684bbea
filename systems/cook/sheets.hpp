// Second step of a surface: who is whose neighbour, which side is out, and one vertex for each fan of triangles.
#pragma once
#include "systems/cook/clean_mesh.hpp"

namespace cullet {

/// Fills positions, position_ids, triangles, neighbours, components, borders and the sources of `surface`.
void make_sheets(CleanMesh clean, Surface& surface);

}  // namespace cullet
