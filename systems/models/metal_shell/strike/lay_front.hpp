// What strikes a metal shell, as a front across its way: from its triangles, whatever its shape.
#pragma once
#include "components/metal_rows.hpp"
#include "engine/events.hpp"
#include "systems/models/metal_shell/shared/striker.hpp"

namespace cullet {

class QueryIndex;
struct ForeseenHit;

/// Where the two stand at the touch.
struct TouchPoses {
    Pose struck, striker;
};
/// As they stand now, or, of a touch that is foreseen, as they will then: its point is of then, too. frame: the one
/// that looks ahead, in which the task opens.
TouchPoses poses_at_touch(const Tasks& tasks, const Bodies& bodies, const Events<ForeseenHit>& foreseen, uint64_t frame,
                          Row<Tasks> task, Row<Bodies> striker);

/// Fills the task's rows of StrikerFronts with the front of what strikes, and how it lies. `touch` has the point and
/// the push, body frame, and the working copy is filled. Plane: it is flat as far as the body reaches, or nobody knows
/// its triangles; nothing is filled then.
StrikerShape lay_front(MetalRows rows, const QueryIndex& index, Row<Tasks> task, Row<Bodies> striker,
                       const TouchPoses& poses, Vec3d point, Vec3d push);

/// The task's striker, as gathered.
Striker striker_of(Read<MetalRows> rows, Row<Tasks> task);

}  // namespace cullet
