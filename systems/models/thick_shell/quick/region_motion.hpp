// How a region moves: from the touch to the hand-off.
#pragma once
#include "components/blows.hpp"
#include "systems/models/thick_shell/hidden/energy.hpp"
#include "systems/models/thick_shell/quick/region.hpp"
#include "systems/models/thick_shell/shared/body_motion.hpp"

namespace cullet {

/// How many rings round the patches a run of so many steps wakes: as far as a wave gets, and a few to spare.
uint32_t region_rings(uint32_t steps);

/// Chooses the region of a task whose shell is filled and whose contacts know their vertices, and takes its springs'
/// rows. False: no room for them; the task is dropped. Serial.
bool wake_region(RunRows& state, Row<Tasks> task, const char** full);
/// When its springs are measured and laid: patches, the striker's speed as the body sees it, step and end of the run.
/// Serial.
void start_region(RunRows& state, const Blows& blows, Row<Tasks> task);
/// All of it, for a task alone.
bool wake_region_alone(RunRows& state, const Blows& blows, Row<Tasks> task, const char** full);
/// Vertices.velocity becomes what the body's own is at the touch and what the run gave, body axes; strikers' speeds as
/// they were measured before; springs are given back. `motion` is the body's own. Serial; once for each run that woke.
void close_region(RunRows& state, Row<Tasks> task, const BodyMotion& motion);

/// Patch springs, from the places before the step (6.3); true when some push. Forces are those of the softened body.
bool region_forces(const RegionView& region);
/// What they give in the step that has just been made.
void push_region(const RegionView& region);
/// Held vertices go back to where they were; what their springs gave them stays in their velocity.
void hold_region(const RegionView& region);

/// Of what moves, as the body sees it. Held vertices have no kinetic energy: nothing works on what stands still.
TaskEnergy region_energy(const RegionView& region);
/// More than was put in, by 5 % of what body and strikers met with: B7's test. The body's own energy is none here, so a
/// floor that pushes has done all the work that there is.
bool has_blown_up(const RegionView& region);

}  // namespace cullet
