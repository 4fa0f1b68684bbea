// Its systems.
#pragma once
#include "systems/world_data.hpp"

namespace cullet::halves {

/// The working copy of the body that was hit, which moves as the body does.
void copy_wholes(EachOwn<TaskOpened> opened, RunRows& rows);
/// The fastest striker and the whole go on as one there, before it breaks.
void push_wholes(EachOwn<TaskOpened> opened, BodyRows& rows);
/// Inner loop: time goes by while the crack runs through; at the end the shell is cut in two, along the blow.
void run_crack(Of<Tasks> task, BodyRows& rows, const Blows& blows);
/// What hangs together.
void find_halves(EachOwn<TaskEnded> ended, RunRows& rows);

}  // namespace cullet::halves
