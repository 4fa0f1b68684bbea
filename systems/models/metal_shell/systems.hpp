// Systems of metal shells.
#pragma once
#include "systems/world_data.hpp"

namespace cullet::metal_shell {

/// Copies the body's rows into the task's. Adds up what strikes the body: one striker, one push and one energy an
/// impact, however many contacts it has.
void gather_impulses(EachOwn<TaskOpened> opened, BodyRows& rows);
/// The whole impact: field, folds, creases, limits; and into the working copy's shape.
void work_impact(Of<Tasks> task, BodyRows& rows);
/// What was dented is one part, in another shape.
void group_dented(EachOwn<TaskEnded> ended, RunRows& rows);

}  // namespace cullet::metal_shell
