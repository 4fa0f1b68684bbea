// A ball that strikes the wall of a dent goes on the way that the dent goes.
#pragma once
#include "systems/models/metal_shell/shared/metal_view.hpp"
#include "systems/models/metal_shell/shared/striker.hpp"

namespace cullet {

/// The same ball, pushed square to the sheet as it was before all impacts, where it touches a dent that goes that way:
/// dents are the envelope of all that came along one axis, and a push along the wall of one would fold it. Anything
/// else stays as it is. Reads MetalVertices.start.
Striker along_dent(const MetalView& metal, const Striker& ball);

/// The way that a push which names its own goes into the sheet at a place: square to it as it was before all impacts,
/// or between two sides where there is an edge. What it does along the sheet only slides. Unit, as `push`.
Vec3d into_sheet(const MetalView& metal, Vec3d point, Vec3d push);

}  // namespace cullet
