// Systems of metal shells.
#pragma once
#include "systems/world_data.hpp"

namespace cullet::metal_shell {

/// Copies the body's rows into the task's. Adds up what strikes the body: one striker, one push and one energy an
/// impact, however many contacts and steps it has. An explosion strikes as a ball whose front is at the body. What is
/// not round gets a front of its triangles, as they lie at the touch.
void gather_impulses(EachOwn<TaskOpened> opened, Step step, const Blows& blows, const Events<ForeseenHit>& foreseen,
                     MetalRows rows, const QueryIndex& index);
/// The whole impact: field, folds, creases, limits; and into the working copy's shape. Where that is stretched too far
/// it tears.
void work_impact(Of<Tasks> task, MetalRows rows, const Blows& blows);
/// Impacts that were worked off are remembered, as what comes soon may be more of them. A sheet's restitution is that
/// of the contacts that are solved now.
void end_impacts(Serial, Step step, const Events<TaskEnded>& ended, MetalRows rows, RigidWorld& rigid);
/// What was dented is one part, in another shape. What tore through may be several.
void group_dented(EachOwn<TaskEnded> ended, MetalRows rows);

}  // namespace cullet::metal_shell
