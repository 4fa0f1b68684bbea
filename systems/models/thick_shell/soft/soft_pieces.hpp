// What comes off an awake soft body.
#pragma once
#include <span>

#include "components/body_rows.hpp"
#include "engine/rigid_world.hpp"
#include "systems/structures/shell/rigid_handoff.hpp"

namespace cullet {

/// Motions of the parts of an awake body's shell from their points' velocities, body axes: momentum and angular
/// momentum are those of the points, and energy can only fall. What holds a pin stands still.
void soft_handoff(const SoftRows& state, Row<SoftBodies> soft, std::span<const FragmentPart> parts,
                  std::span<PartMotion> motions);
/// New bodies that a torn one made of its parts, in this order of parts, get springs that remember what those of their
/// elements did, and wake in the next step. One that finds no room stays rigid. A part that made none has no child, and
/// the child of the part that keeps the body is the body.
void give_pieces_springs(SoftRows& state, Row<SoftBodies> torn, Row<Bodies> body, std::span<const uint32_t> order,
                         std::span<const FragmentPart> parts, std::span<const Row<Bodies>> child);
/// What is left of the body goes on: points that left stand still, and the rigid world has no contacts of it.
void keep_torn(SoftRows& state, RigidWorld& rigid, Row<SoftBodies> torn, Row<Bodies> body);

}  // namespace cullet
