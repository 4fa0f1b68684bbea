// Which way a dented sheet looks.
#pragma once
#include "systems/models/metal_shell/shared/metal_view.hpp"

namespace cullet {

/// Normals of the corners of elements that go from MetalVertices.start to another place, and the sheet's way in at
/// vertices that do. Corners at one vertex that had one normal keep having one, but for a fold that is sharp now.
/// Hulls of these elements' cells are stale.
void turn_normals(const MetalView& metal);

}  // namespace cullet
