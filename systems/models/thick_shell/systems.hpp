// Systems of thick shells: what is brittle, quick or soft. model.cpp gives their slots, loops.cpp the inner loops.
#pragma once
#include "components/shell_groups.hpp"
#include "systems/world_data.hpp"

namespace cullet {

// ---- slot Rest

/// Soft bodies that have been quiet long enough are rigid again, in the shape that they have.
void freeze_soft_bodies(Serial, SoftRows& rows, RigidWorld& rigid, Arena& arena);

// ---- slot Wake

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
/// Wakes ductile and elastic bodies that something hits hard enough, or that lose what they lay against: they begin to
/// move by their springs.
void wake_soft_bodies(Serial, SoftRows& rows, RigidWorld& rigid);
/// Whom each soft body that is awake may meet in this frame.
void find_soft_strikers(Rows<SoftBodies> soft, Step step, InChunks<SoftRows> rows, const RigidWorld& rigid);
/// A body that several of them meet lends each a copy of itself, with an equal part of its mass.
void share_soft_strikers(Serial, Tables<const Bodies, const SoftBodies, SoftStrikers> rows);

// ---- slots Pass and Close

/// Shape, pose and motion of soft bodies after their substeps.
void shape_soft(Rows<SoftBodies> soft, Step step, InChunks<SoftRows> rows);
/// What soft bodies gave to what they met, and where they are now, for the rigid world.
void pass_soft(Serial, Step step, SoftRows& rows, RigidWorld& rigid, DamageCounts& counts, Arena& arena,
               Events<FaultEvent>& faults);
/// Regions whose run ended fall asleep: vertices get the body's own motion back, and the springs' rows are given back.
/// What a cut-out changed goes into the body's shell (models/thick_shell/shared/cut_out.hpp).
void close_regions(Serial, Own<TaskEnded> ended, BodyRows& rows, Events<CrackStartedEvent>& cracks);

// ---- slots Group, GiveBack and Show

/// Which elements of a broken shell hang together.
void find_parts(EachOwn<TaskEnded> ended, BodyRows& rows);
/// Smooths the cracks of a run that ended, by one pass of (1/4, 1/2, 1/4) along them. So they are drawn, and so they
/// collide.
void smooth_cracks(EachOwn<TaskEnded> ended, SmoothedTables rows, const Tasks& tasks, const Blows& blows);
/// The rest of what soft bodies gave. The bodies that they met have been moved as the run moved them. Now they get the
/// velocity that they had at its end.
void return_soft(Serial, const SoftBodies& soft, const SoftStrikers& strikers, RigidWorld& rigid);
/// Soft bodies that are awake are drawn anew.
void show_soft(Serial, SoftRows& rows, Events<DrawnChanged>& changed, Events<RefusedEvent>& refused);

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

// ---- inner loop of springs: repeated for one shell that has them (ductile, quick mode)

/// One layer in one fused pass. It adds up force, area energy where the row has any, and damping from the length kept
/// in the slot. Then it steps by semi-implicit Euler, and notes each vertex's largest elongation.
void integrate_springs(Rows<SpringPacks> packs, Of<ShellSprings> springs, Turn turn, InChunks<SteppedTables> rows);
/// The same for both layers and what ties them.
void integrate_layers(Rows<SpringPacks> packs, Of<ShellSprings> springs, Turn turn, InChunks<SteppedTables> rows);
/// The sides of the positions change places.
void end_spring_step(Of<ShellSprings> springs, ShellSprings& own);

// ---- inner loop of a soft body: the systems of springs, and

/// Contacts of the vertices that the springs' step put into a striker, in row order. They are inelastic impulses with
/// Coulomb friction, between vertices and the strikers' copies.
void meet_strikers(Of<SoftBodies> soft_body, Of<ShellSprings> springs, Turn turn, MeetingTables rows,
                   const SoftBodies& soft, SoftStrikers& strikers, SoftContacts& contacts);
/// Hinges of sheets whose material has a bending stiffness of its own, once in some substeps.
void bend_sheets(Of<ShellSprings> springs, BentTables rows);
/// Springs above yield get longer or shorter for good.
void flow_springs(Rows<Springs> springs, Of<ShellSprings> of, Of<SoftBodies> soft_body, InChunks<FlowingTables> rows,
                  const SoftBodies& soft);
/// Springs may be stretched beyond what they bear: then a vertex is split across the most stretched one.
void tear_springs(Of<SoftBodies> soft_body, Of<ShellSprings> springs, SoftRows& rows);

}  // namespace cullet
