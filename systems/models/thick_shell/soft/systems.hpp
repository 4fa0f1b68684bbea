// Systems of soft bodies, which are ductile or elastic and move by their springs.
#pragma once
#include "components/shell_groups.hpp"
#include "systems/world_data.hpp"

namespace cullet {

/// Soft bodies that have been quiet long enough are rigid again, in the shape that they have.
void freeze_soft_bodies(Serial, SoftRows& rows, RigidWorld& rigid, Arena& arena);
/// Wakes ductile and elastic bodies that something hits hard enough, or that lose what they lay against: they begin to
/// move by their springs.
void wake_soft_bodies(Serial, SoftRows& rows, RigidWorld& rigid);
/// Whom each soft body that is awake may meet in this frame.
void find_soft_strikers(Rows<SoftBodies> soft, Step step, InChunks<SoftRows> rows, const RigidWorld& rigid);
/// A body that several of them meet lends each a copy of itself, with an equal part of its mass.
void share_soft_strikers(Serial, Tables<const Bodies, const SoftBodies, SoftStrikers> rows);
/// Shape, pose and motion of soft bodies after their substeps.
void shape_soft(Rows<SoftBodies> soft, Step step, InChunks<SoftRows> rows);
/// What soft bodies gave to what they met, and where they are now, for the rigid world.
void pass_soft(Serial, Step step, SoftRows& rows, RigidWorld& rigid, DamageCounts& counts, Arena& arena,
               Events<FaultEvent>& faults);
/// The rest of what soft bodies gave. The bodies that they met have been moved as the run moved them. Now they get the
/// velocity that they had at its end.
void return_soft(Serial, const SoftBodies& soft, const SoftStrikers& strikers, RigidWorld& rigid);
/// Soft bodies that are awake are drawn anew.
void show_soft(Serial, SoftRows& rows, Events<DrawnChanged>& changed, Events<RefusedEvent>& refused);

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
