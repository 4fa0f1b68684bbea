// Systems of the hidden run, which breaks what is brittle.
#pragma once
#include "components/shell_groups.hpp"
#include "systems/world_data.hpp"

namespace cullet {

/// Some hidden runs work on a part of a body. Those that came to its border begin again on a larger part
/// (models/thick_shell/hidden/hidden_region.hpp).
void widen_regions(Serial, Owner own, BodyRows& rows, Events<TaskOpened>& opened, Events<RefusedEvent>& refused);
/// Lists the stiffness of their working copies that the body's shell does not have.
void want_stiffness(Serial, Own<TaskOpened> opened, RunKinds rows, Events<StiffnessWanted>& wanted);
/// Copies the body's shell into the task's.
void fill_tasks(EachOwn<TaskOpened> opened, RunRows& rows);
/// Assembles it: of a cut-out, and of a piece that is hit for the first time.
void fill_stiffness(Each<StiffnessWanted> wanted, RunRows& rows);
/// Lays the contact patches. Gives every vertex the body's velocity and what explosions add. Cuts are made here. They
/// ask the boxes of the body's pins which of their sides they hold.
void start_tasks(EachOwn<TaskOpened> opened, BodyRows& rows, Blows& blows);

// ---- inner loop of a brittle shell: repeated for one task

/// Contact springs of the patches, from the displacements before the step.
void push_patches(Of<Tasks> task, PatchTables rows);
/// One fused pass: f_i = sum_j K_ij (w_j - w_i); v += dt f / m; u += dt v; next w = u + beta v.
void integrate_hidden(Rows<StiffnessPacks> packs, Of<Tasks> task, RunStiffness of,
                      In<&Vertices::inverse_mass> inverse_mass, In<&Vertices::probe> probe,
                      InOut<&Vertices::velocity> velocity, InOut<&Vertices::displacement> displacement,
                      Out<&Vertices::probe> next_probe);
/// Gives patch vertices and strikers what the springs pushed. The run ends when its time is up or all is quiet.
void pass_impulses(Of<Tasks> task, Turn turn, PassedTables rows);
/// Strain of each element and its slopes against its edges.
void strain_check(Rows<Elements> elements, Of<Tasks> task, Turn turn, InChunks<TaskStress> rows);
/// Stress of both faces of each element, and the largest principal value, which decides whether it cracks.
void stress_check(Rows<Elements> elements, Of<Tasks> task, InChunks<TaskStress> rows);
/// Starts and advances cracks, one body a call, in order of urgency.
void split_vertices(Of<Tasks> task, RunRows& rows);
/// Above 1.05 of the start's energy the run begins again with half the step, at most twice.
void check_energy(Of<Tasks> task, RunRows& rows, const Blows& blows);

}  // namespace cullet
