#pragma once
#include "components/run_rows.hpp"

namespace cullet {

/// A task goes before its end: what a quick run keeps for it goes back, and no cut-out stands for it.
void cancel_run(RunRows& state, Row<Tasks> task);

}  // namespace cullet
