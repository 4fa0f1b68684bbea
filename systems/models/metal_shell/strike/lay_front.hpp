// What strikes a metal shell, as a front across its way: from its triangles, whatever its shape.
#pragma once
#include "components/metal_rows.hpp"
#include "systems/models/metal_shell/shared/striker.hpp"

namespace cullet {

class QueryIndex;

/// Fills the task's rows of StrikerFronts with the front of what strikes, and how it lies. `touch` has the point and
/// the push, body frame, and the working copy is filled. Plane: it is flat as far as the body reaches, or nobody knows
/// its triangles; nothing is filled then.
StrikerShape lay_front(MetalRows rows, const QueryIndex& index, Row<Tasks> task, Row<Bodies> striker, Vec3d point,
                       Vec3d push);

/// The task's striker, as gathered.
Striker striker_of(Read<MetalRows> rows, Row<Tasks> task);

}  // namespace cullet
