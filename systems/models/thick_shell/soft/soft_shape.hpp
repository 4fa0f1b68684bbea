// From the points of an awake body to what the rest of the program sees of it.
#pragma once
#include "components/body_rows.hpp"
#include "engine/system.hpp"

namespace cullet {

/// After a frame's substeps. Motion about the rigid one loses a share: air, and what springs lose that the damping of
/// single ones does not see. The pose that fits the points best goes to the body's row; where the body is pinned, that
/// of before. So do V and w that have the points' momentum and angular momentum. Vertices.rest becomes the shape in the
/// body frame. Inward directions and the game's normals turn with it. Counts how long it has been quiet. Points that
/// are not finite, or faster than anything may be, are put back to the shape before, at rest about the body's motion,
/// and soft.has_fault tells.
void end_soft_frame(SoftRows& state, Row<SoftBodies> soft, const Step& step);

}  // namespace cullet
