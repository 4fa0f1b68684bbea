// The systems of a frame that all damage models share. The parameters of each are all that it sees; frame.cpp gives
// their order. A model's own systems, and those of a structure, stand in the systems.hpp of its folder.
#pragma once
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

// ---- damage

/// Shares the frame's units: one step to each open task, then equal rounds, in order of (frame of impact, body row).
/// Soft bodies that are awake come first, with up to half of the units: they run on the world's clock.
void grant_units(Serial, WorldRows& rows, DamageLedger ledger);
/// Runs the inner loops on all workers (engine/runs.hpp). Open tasks run the steps that they were granted, awake soft
/// bodies the whole frame.
void advance_runs(Serial, WorldRows& rows, const Blows& blows, const DamageModels& models, RunLoops& loops,
                  DamageCounts& counts);
/// Holds bodies whose task goes on. Releases those whose time is up or whose task ended. Names runs whose cracks had no
/// room.
void settle_tasks(Serial, Step step, RunTables runs, Bodies& bodies, const Structures& structures, RigidWorld& rigid,
                  DamageLedger ledger, Events<TaskEnded>& ended, ToldOfHits told);

// ---- apply

/// Which pieces become bodies or debris, in order of mass, and the rows that they need. What stayed whole keeps its
/// cracks. What finds no room stays part of the body, and asks again.
void plan_births(Serial, const Events<TaskEnded>& ended, WorldRows& rows, WaitingHits waiting, Pieces pieces,
                 const Debris& debris, DamageLedger ledger, Arena& arena, PlannedBirths planned);
/// Measures what is left of each body. Hulls of cells that moved as they were are copied; the others are listed.
void plan_hulls(Serial, const Events<Break>& breaks, const Fragments& fragments, WorldRows& rows, RigidWorld& rigid,
                Events<HullWanted>& wanted);
/// The pieces enter the rigid world, in order of mass. The striker gets the impulse that it really passed. Closes the
/// tasks that ended.
void make_births(Serial, Step step, EndedTasks over, WorldRows& rows, Blows& blows, DebrisTables debris_tables,
                 RigidWorld& rigid, BirthAccounts accounts, ToldOfBirths told);

// ---- solve

/// Solves contacts and moves all bodies, old and new.
void solve_rigid(Serial, Step step, RigidWorld& rigid);
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
                   DebrisTables debris_tables, const DamageModels& models, RigidWorld& rigid, ToldOfGrinding told);
/// Two that yield to nothing may leave a body too little room. If it can give way no further it is held between them,
/// in both alike, and goes free where it is. As long as the one on the other side can give way it goes as the first
/// does. What moves by its springs is woken.
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

/// Boxes of the drawn triangles of each shell that changed.
void bound_drawn(Each<DrawnChanged> changed, Bodies& bodies, const ViewVertices& vertices, const ViewIndices& indices,
                 ViewBoxes& boxes);
/// The tree that queries go down.
void refresh_queries(Serial, const Bodies& bodies, QueryIndex& index);

}  // namespace cullet
