// What the rest of the program asks of soft bodies: calls of the thick shell (model_calls.hpp).
#pragma once
#include "systems/model_calls.hpp"

namespace cullet {

/// Of a body that is awake.
std::optional<MechanicalEnergy> soft_energy(SoftRows& state, Row<Bodies> body, Vec3 gravity);
/// Of one that may be awake, and is then.
bool push_soft_body(SoftRows& state, RigidWorld& rigid, Row<Bodies> body, const PointPush& push);
bool explode_soft_body(SoftRows& state, RigidWorld& rigid, Row<Bodies> body, const Explosion& explosion);
/// It wakes in the next step.
bool call_up_soft_body(SoftRows& state, Row<Bodies> body);
/// Somebody who does not yield moves into one that is awake.
bool is_soft_driven_into(const SoftRows& state);

}  // namespace cullet
