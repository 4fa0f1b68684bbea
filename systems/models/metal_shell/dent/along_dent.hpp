// A ball that strikes the wall of a dent goes on the way that the dent goes.
#pragma once
#include "systems/models/metal_shell/shared/metal_view.hpp"
#include "systems/models/metal_shell/shared/striker.hpp"

namespace cullet {

/// The same ball, pushed square to the sheet as it was before all impacts, where it touches a dent that goes that way:
/// dents are the envelope of all that came along one axis, and a push along the wall of one would fold it. Anything
/// else stays as it is. Reads MetalVertices.start.
Striker along_dent(const MetalView& metal, const Striker& ball);

}  // namespace cullet
