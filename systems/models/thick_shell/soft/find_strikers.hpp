// Whom an awake body may meet in this frame, and where.
#pragma once
#include "components/body_rows.hpp"
#include "engine/rigid_world.hpp"
#include "engine/system.hpp"

namespace cullet {

/// Bodies near enough, by rising row, and for each vertex the plane of each that is nearest to it: rows of SoftStrikers
/// and SoftContacts. Other soft bodies may do the same at once. O(vertices times bodies near).
void find_strikers(SoftRows& state, const RigidWorld& rigid, Row<SoftBodies> soft, const Step& step);

/// A body that several soft ones may meet in this frame lends each a copy of itself with an equal part of its mass:
/// each copy's meeting loses energy, and so does their mean. Serial.
void share_strikers(Tables<const Bodies, const SoftBodies, SoftStrikers> state);

}  // namespace cullet
