// Systems of the quick mode: springs in the neighbourhood of each hit.
#pragma once
#include "components/shell_groups.hpp"
#include "systems/world_data.hpp"

namespace cullet {

/// Quick bodies: chooses the neighbourhood of each hit (models/thick_shell/quick/region.hpp) and takes rows for its
/// springs.
void wake_regions(Serial, Own<TaskOpened> opened, RunRows& rows, const Bodies& bodies, Events<RegionPart>& parts,
                  Events<RefusedEvent>& refused);
/// Lengths, stiffness and damping of its springs.
void measure_regions(Each<RegionPart> part, RunRows& rows);
/// Its vertices' lists of them.
void lay_regions(Each<RegionPart> part, RunRows& rows);
/// Its time step, and it stands at rest as the body sees it.
void start_regions(Serial, Own<TaskOpened> opened, RunRows& rows, const Blows& blows);
/// Regions whose run ended fall asleep: vertices get the body's own motion back, and the springs' rows are given back.
/// What a cut-out changed goes into the body's shell (models/thick_shell/shared/cut_out.hpp).
void close_regions(Serial, Own<TaskEnded> ended, BodyRows& rows, Events<CrackStartedEvent>& cracks);

// ---- inner loop of the quick mode: repeated for one task whose region is awake

/// Patch springs, from the places before the step, softened as the region is.
void push_region_patches(Of<Tasks> task, RunRows& rows);
/// integrate_springs, or integrate_layers, for the region's packs.
void integrate_region(Rows<MarkedPacks> packs, Of<Tasks> task, Turn turn, InChunks<SteppedRegion> rows);
/// What is held goes back, patches push, strikers move. The run ends after its steps.
void end_region_step(Of<Tasks> task, RunRows& rows);
/// Splits what has stretched too far, as the published method does.
void split_region(Of<Tasks> task, RunRows& rows);
/// Above 1.05 of the start's energy the run is dropped.
void check_region_energy(Of<Tasks> task, RunRows& rows);

}  // namespace cullet
