// Every system of a frame. The parameters of each are all that it sees; frame.cpp gives their order.
#pragma once
#include "components/shell_groups.hpp"
#include "systems/world_data.hpp"

namespace cullet {

// ---- start

/// The pose of the last step, for interpolation.
void remember_poses(Rows<Bodies> bodies, In<&Bodies::position> position, In<&Bodies::orientation> orientation,
                    Out<&Bodies::previous_position> previous_position,
                    Out<&Bodies::previous_orientation> previous_orientation);
/// Finds which bodies the game's blows reach. Balls and unbreakable bodies are pushed at once.
void take_blows(Serial, Blows& blows, WorldRows& rows, RigidWorld& rigid, const DamageModels& models,
                DamageCounts& counts, Events<RefusedEvent>& refused);
/// Checked and Debug builds: the energy that the frame begins with, with the game's blows on unbreakable bodies in it.
void open_energy_balance(Serial, Step step, WorldRows& rows, const Debris& debris, const DamageModels& models,
                         const DamageCounts& counts, const RigidWorld& rigid, EnergyBalance& balance);
/// Soft bodies that have been quiet long enough are rigid again, in the shape that they have.
void freeze_soft_bodies(Serial, SoftRows& rows, RigidWorld& rigid, Arena& arena);
/// Sweeps fast bodies to their time of impact, finds all contacts of this step.
void detect_contacts(Serial, Step step, RigidWorld& rigid);
/// Contacts that a breakable body may not survive, sorted by body and speed.
void predict_impacts(Serial, Step step, const RigidWorld& rigid, const Bodies& bodies, const Structures& structures,
                     RunsNow runs, const DamageSettings& settings, Events<Impact>& impacts);
/// The first touches of bodies in flight that may break something, up to settings.frames_ahead before they come.
void foresee_impacts(Serial, Step step, RigidWorld& rigid, const Bodies& bodies, const Structures& structures,
                     RunsNow runs, const DamageSettings& settings, Arena& arena, Events<ForeseenHit>& foreseen);
/// Looks at tasks that were opened ahead of their touch. If the touch has come as foreseen they go on as tasks of this
/// step, and their result is due in it. If it came otherwise, or did not come, they are dropped. As foreseen means: the
/// same striker, the same cell, the speed to a tenth, and nobody faster by more than that.
void meet_foreseen(Serial, Step step, WorldRows& rows, const Blows& blows, DamageLedger ledger, Events<Impact>& impacts,
                   Events<ImpactEvent>& impact_events);
/// Opens one damage task for each body that was hit: asks the game, and takes rows for the working copy. A further hit
/// on a body whose task is open waits in QueuedHits. So do all hits while every task is taken. Waiting hits open tasks
/// when their bodies can, the oldest first. Blows of the game are treated as contacts are. So are touches that are
/// foreseen, behind all others.
void open_tasks(Serial, Step step, const Events<Impact>& impacts, const Events<ForeseenHit>& foreseen, WorldRows& rows,
                WaitingHits waiting, RigidWorld& rigid, DamageLedger ledger, OpenedTasks out);
/// Wakes ductile and elastic bodies that something hits hard enough, or that lose what they lay against: they begin to
/// move by their springs.
void wake_soft_bodies(Serial, SoftRows& rows, RigidWorld& rigid);
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

// ---- damage

/// Shares the frame's units: one step to each open task, then equal rounds, in order of (frame of impact, body row).
/// Soft bodies that are awake come first, with up to half of the units: they run on the world's clock.
void grant_units(Serial, WorldRows& rows, DamageLedger ledger);
/// Whom each soft body that is awake may meet in this frame.
void find_soft_strikers(Rows<SoftBodies> soft, Step step, InChunks<SoftRows> rows, const RigidWorld& rigid);
/// A body that several of them meet lends each a copy of itself, with an equal part of its mass.
void share_soft_strikers(Serial, Tables<const Bodies, const SoftBodies, SoftStrikers> rows);
/// Runs the inner loops on all workers (engine/runs.hpp): of open tasks for the steps that they were granted, and of
/// awake soft bodies through the frame.
void advance_runs(Serial, WorldRows& rows, const Blows& blows, const DamageModels& models, RunLoops& loops,
                  DamageCounts& counts);
/// Shape, pose and motion of soft bodies after their substeps.
void shape_soft(Rows<SoftBodies> soft, Step step, InChunks<SoftRows> rows);
/// What soft bodies gave to what they met, and where they are now, for the rigid world.
void pass_soft(Serial, Step step, SoftRows& rows, RigidWorld& rigid, DamageCounts& counts, Arena& arena,
               Events<FaultEvent>& faults);
/// Holds bodies whose task goes on. Releases those whose time is up or whose task ended. Names runs whose cracks had no
/// room.
void settle_tasks(Serial, Step step, RunTables runs, Bodies& bodies, const Structures& structures, RigidWorld& rigid,
                  DamageLedger ledger, Events<TaskEnded>& ended, ToldOfHits told);

/// Regions whose run ended fall asleep: vertices get the body's own motion back, and the springs' rows are given back.
/// What a cut-out changed goes into the body's shell (models/thick_shell/shared/cut_out.hpp).
void close_regions(Serial, Own<TaskEnded> ended, BodyRows& rows, Events<CrackStartedEvent>& cracks);

// ---- apply

/// Which elements of a broken shell hang together.
void find_parts(EachOwn<TaskEnded> ended, BodyRows& rows);
/// Smooths the cracks of a run that ended, by one pass of (1/4, 1/2, 1/4) along them (C6). So they are drawn, and so
/// they collide.
void smooth_cracks(EachOwn<TaskEnded> ended, SmoothedTables rows, const Tasks& tasks, const Blows& blows);
/// Which pieces become bodies or debris, in order of mass, and the rows that they need. What stayed whole keeps its
/// cracks. What finds no room stays part of the body, and asks again.
void plan_births(Serial, const Events<TaskEnded>& ended, WorldRows& rows, WaitingHits waiting, Pieces pieces,
                 const Debris& debris, DamageLedger ledger, Arena& arena, PlannedBirths planned);
/// Copies each piece into its rows, marks the old ones dead and chooses what shapes collide (piece_shape.hpp).
/// Meanwhile it settles the pieces' motions (settle_momenta).
void fill_births(Each<Birth> birth, const Events<Break>& breaks, MetalShellRows rows, Fragments& fragments,
                 Touches& touches, const Bodies& bodies);
/// Measures what is left of each body. Hulls of cells that moved as they were are copied; the others are listed.
void plan_hulls(Serial, const Events<Break>& breaks, const Fragments& fragments, WorldRows& rows, RigidWorld& rigid,
                Events<HullWanted>& wanted);
/// Chooses the hull points of each cell that changed. Finds the faces of its hull, or of a piece's one shape, for the
/// rigid world.
void fill_hulls(Each<HullWanted> wanted, ShellRows& rows, Tables<const MetalOwners, const MetalShells> metal,
                const RigidWorld& rigid);
/// The pieces enter the rigid world, in order of mass. The striker gets the impulse that it really passed. Closes the
/// tasks that ended.
void make_births(Serial, Step step, EndedTasks over, WorldRows& rows, Blows& blows, Crumbs crumbs, RigidWorld& rigid,
                 BirthAccounts accounts, ToldOfBirths told);

// ---- solve

/// Solves contacts and moves all bodies, old and new.
void solve_rigid(Serial, Step step, RigidWorld& rigid);
/// The rest of what soft bodies gave. The bodies that they met have been moved as the run moved them. Now they get the
/// velocity that they had at its end.
void return_soft(Serial, const SoftBodies& soft, const SoftStrikers& strikers, RigidWorld& rigid);
/// Poses, velocities and sleep of the rigid world, back into rows.
void read_rigid(Serial, const RigidWorld& rigid, Bodies& bodies, Events<AsleepEvent>& asleep);
/// Weighs what lies on a body or squeezes it, by the impulses of the last solve (a host tells them with its contacts).
/// If that is for some steps more than the body bears (impacts/overload.hpp), a hit that stands for the load is put in
/// QueuedHits. A run on the body that has cracked nothing makes way. What is too small to come apart is listed, when
/// nothing else makes way.
void weigh_loads(Serial, Step step, RigidWorld& rigid, WorldRows& rows, QueuedHits& queued, const Blows& blows,
                 DamageRules rules, Arena& arena, ToldOfLoads told);
/// Each of those becomes debris with its mass and its motion. Without room it stays as it is, and asks again.
void grind_crushed(Serial, Step step, const Events<Crushed>& crushed, WorldRows& rows, WaitingHits waiting,
                   Crumbs crumbs, const DamageModels& models, RigidWorld& rigid, ToldOfGrinding told);
/// What two that yield to nothing leave too little room, and what can give way no further, is held between them, in
/// both alike, and goes free where it is. As long as the one on the other side can give way it goes as the first does.
/// What moves by its springs is woken.
void hold_squeezed(Serial, Step step, RigidWorld& rigid, WorldRows& rows, DamageLedger ledger, Arena& arena,
                   Events<SqueezedEvent>& told);
/// Debris flies on parabolas, bounces off the ground and off bodies larger than itself, slides and comes to rest. A
/// host keeps its shapes to itself. In its world debris knows only the floor below its place of birth.
void fall_debris(Serial, Step step, const RigidWorld& rigid, Debris& debris, DamageCounts& counts);
/// Checked and Debug builds: between this and its opening the frame made no energy (checks/energy_balance.hpp).
void close_energy_balance(Serial, Step step, WorldRows& rows, const Debris& debris, const DamageModels& models,
                          const DamageCounts& counts, const RigidWorld& rigid, EnergyBalance& balance,
                          Events<FaultEvent>& faults);
/// Debris that is older than the game wants goes.
void fade_debris(Serial, Step step, Debris& debris, const DebrisAges& ages, const DamageSettings& settings,
                 DamageCounts& counts);

// ---- end

/// Soft bodies that are awake are drawn anew.
void show_soft(Serial, SoftRows& rows, Events<ShellChanged>& changed, Events<RefusedEvent>& refused);
/// The drawn mesh of each shell that changed. Of what a hit left of a body, only the cells that it changed.
void draw_shells(Each<ShellChanged> changed, Step step, BodyRows& rows, ViewBoxes& boxes);
/// What the vertices of a large body weigh, block by block, where a hit changed them: the next hit looks no farther.
void measure_blocks(Each<ShellChanged> changed, const Bodies& bodies, MeasuredBlocks rows);
/// Boxes of the drawn triangles of each shell that changed.
void bound_drawn(Each<ShellChanged> changed, Bodies& bodies, const ViewVertices& vertices, const ViewIndices& indices,
                 ViewBoxes& boxes);
/// The tree that queries go down.
void refresh_queries(Serial, const Bodies& bodies, QueryIndex& index);
/// Shells that lost a quarter of their rows to pieces have the live ones moved together: in quiet frames, for units.
void compact_shells(Serial, BodyRows& rows, MetalTables metal, DamageCounts& counts, const Events<TaskEnded>& ended);

// ---- inner loop of a brittle thick shell: repeated for one task

/// Contact springs of the patches, from the displacements before the step (6.3).
void push_patches(Of<Tasks> task, PatchTables rows);
/// One fused pass (section 10): f_i = sum_j K_ij (w_j - w_i); v += dt f / m; u += dt v; next w = u + beta v.
void integrate_hidden(Rows<StiffnessPacks> packs, Of<Tasks> task, RunStiffness of,
                      In<&Vertices::inverse_mass> inverse_mass, In<&Vertices::probe> probe,
                      InOut<&Vertices::velocity> velocity, InOut<&Vertices::displacement> displacement,
                      Out<&Vertices::probe> next_probe);
/// Gives patch vertices and strikers what the springs pushed. The run ends when its time is up or all is quiet (6.4).
void pass_impulses(Of<Tasks> task, Turn turn, PassedTables rows);
/// Strain of each element and its slopes against its edges.
void strain_check(Rows<Elements> elements, Of<Tasks> task, Turn turn, InChunks<TaskStress> rows);
/// Stress of both faces of each element, and the largest principal value (C1).
void stress_check(Rows<Elements> elements, Of<Tasks> task, InChunks<TaskStress> rows);
/// Starts and advances cracks, one body a call, in order of urgency (C1 to C5).
void split_vertices(Of<Tasks> task, RunRows& rows);
/// Above 1.05 of the start's energy the run begins again with half the step, at most twice (B7).
void check_energy(Of<Tasks> task, RunRows& rows, const Blows& blows);

// ---- inner loop of the quick mode: repeated for one task whose region is awake

/// Patch springs, from the places before the step, softened as the region is.
void push_region_patches(Of<Tasks> task, RunRows& rows);
/// integrate_springs, or integrate_layers, for the region's packs.
void integrate_region(Rows<MarkedPacks> packs, Of<Tasks> task, Turn turn, InChunks<SteppedRegion> rows);
/// What is held goes back, patches push, strikers move. The run ends after its steps.
void end_region_step(Of<Tasks> task, RunRows& rows);
/// Splits what has stretched too far (C3 to C5, paper mode).
void split_region(Of<Tasks> task, RunRows& rows);
/// Above 1.05 of the start's energy the run is dropped.
void check_region_energy(Of<Tasks> task, RunRows& rows);

// ---- inner loop of springs: repeated for one shell that has them (ductile, quick mode, sheet metal)

/// One layer in one fused pass (B3, B4, B6). It adds up force, area energy where the row has any, and damping from the
/// length kept in the slot. Then it steps by semi-implicit Euler, and notes each vertex's largest elongation.
void integrate_springs(Rows<SpringPacks> packs, Of<ShellSprings> springs, Turn turn, InChunks<SteppedTables> rows);
/// The same for both layers and what ties them (B5).
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
/// Springs above yield get longer or shorter for good (6.8).
void flow_springs(Rows<Springs> springs, Of<ShellSprings> of, Of<SoftBodies> soft_body, InChunks<FlowingTables> rows,
                  const SoftBodies& soft);
/// Springs may be stretched beyond what they bear: then a vertex is split across the most stretched one (C1, C3).
void tear_springs(Of<SoftBodies> soft_body, Of<ShellSprings> springs, SoftRows& rows);

}  // namespace cullet
