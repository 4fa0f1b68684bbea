// What the game gives, looked at before it enters rows. Refusals are one sentence.
#pragma once
#include <string>

#include "components/bodies.hpp"
#include "cullet/world.hpp"
#include "engine/rigid_bounds.hpp"

namespace cullet {

std::string text(Vec3 v);

Result<void> check_pose(const Pose& pose);
Result<void> check_motion(const Motion& motion);
Result<void> check_contact(const ContactSettings& contact);
/// What every kind of body is asked.
Result<void> check_body(const Pose& pose, const Motion& motion, const ContactSettings& contact);
/// Of the thing named.
Result<void> check_gravity(const char* name, Vec3 gravity);
Result<void> check_settings(const Settings& settings);

/// There is no memory for a world of these limits.
Error no_room_for(const LimitSettings& limits);

/// "body handle 7 names nothing that is alive; ..."
Error stale(const char* what, uint32_t index);

}  // namespace cullet
