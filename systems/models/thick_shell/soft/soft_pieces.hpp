// What comes off an awake soft body.
#pragma once
#include "components/body_rows.hpp"
#include "engine/rigid_world.hpp"
#include "systems/births/break.hpp"

namespace cullet {

/// Motions of the fragments of an awake body, all of them in turn, from their points' velocities, body axes: momentum
/// and angular momentum are those of the points, and energy can only fall. What holds a pin stands still.
void soft_handoff(const SoftRows& state, Row<SoftBodies> soft, Fragments& fragments, Rows<Fragments> of);
/// New bodies that a torn one made of its fragments, the heaviest first, get springs that remember what those of their
/// elements did, and wake in the next step. One that finds no room stays rigid.
void give_pieces_springs(SoftRows& state, Row<SoftBodies> torn, const Break& of, const Fragments& fragments);
/// What is left of the body goes on: points that left stand still, and the rigid world has no contacts of it.
void keep_torn(SoftRows& state, RigidWorld& rigid, Row<SoftBodies> torn, Row<Bodies> body);

}  // namespace cullet
