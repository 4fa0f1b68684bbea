// A damage task from its start.
#pragma once
#include "components/blows.hpp"
#include "components/run_rows.hpp"

namespace cullet {

/// Fills the working shell from the body's, makes its stiffness ready, lays patches, gives vertices and strikers the
/// velocities of the touch. Nothing allocates.
void start_task(RunRows& state, const Blows& blows, Row<Tasks> task);

/// start_task in parts, around assemble_packs where the body's stiffness is not assembled: the rows; then patches and
/// velocities.
void fill_task(RunRows& state, Row<Tasks> task);
void start_run(RunRows& state, const Blows& blows, Row<Tasks> task);

/// The Scratch columns that live on between the steps of a run, from its State: after a load.
void restore_scratch(RunRows& state, Row<Tasks> task);

}  // namespace cullet
