// The systems of the model.
#pragma once
#include "systems/world_data.hpp"

namespace cullet::lattice {

/// The blow of a task that opens, and a room for its run.
void start_breaks(EachOwn<TaskOpened> opened, LatticeRows rows, const Blows& blows);
/// Inner loop: one step of the break; the last ones cut the pieces' skins and choose their hulls.
void work_break(Of<Tasks> task, LatticeRows rows);
/// What came of it.
void count_pieces(EachOwn<TaskEnded> ended, Tables<Tasks, SolidWork> rows);

}  // namespace cullet::lattice
