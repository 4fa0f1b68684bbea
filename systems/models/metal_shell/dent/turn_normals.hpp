// Which way a dented sheet looks.
#pragma once
#include "systems/models/metal_shell/shared/metal_view.hpp"

namespace cullet {

/// A corner of the element goes from MetalVertices.start to another place.
bool has_moved(const MetalView& metal, uint32_t element);

/// Normals of the corners of elements that moved, and the sheet's way in at vertices that did. The rest shape is the
/// new one already. Corners at one vertex that had one normal keep having one, but for a fold that is sharp now.
void turn_normals(const MetalView& metal);

}  // namespace cullet
