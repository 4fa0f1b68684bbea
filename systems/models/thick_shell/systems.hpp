// Systems of thick shells that go through whole bodies. Those of a run stand in hidden/ and quick/, those of what moves
// by its springs in soft/ and springs/. model.cpp gives their slots, loops.cpp the inner loops.
#pragma once
#include "components/shell_groups.hpp"
#include "systems/world_data.hpp"

namespace cullet {

/// Which elements of a broken shell hang together.
void find_parts(EachOwn<TaskEnded> ended, BodyRows& rows);
/// Smooths the cracks of a run that ended, by one pass of (1/4, 1/2, 1/4) along them. So they are drawn, and so they
/// collide.
void smooth_cracks(EachOwn<TaskEnded> ended, SmoothedTables rows, const Tasks& tasks, const Blows& blows);

}  // namespace cullet
