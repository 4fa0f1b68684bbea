// What a run that was dropped left in its rows.
#pragma once
#include "components/run_rows.hpp"

namespace cullet {

/// Points, speeds and lengths of the task's shell and of its springs, and what its contacts passed, are those of a body
/// at rest. A run that went wrong may have left what is not finite. That must not stay in rows that go back to their
/// pools, nor in the body's own shell: a snapshot with it is refused. Serial; O(rows of the shell), for faults alone.
void forget_run(RunRows& state, Row<Tasks> task);

}  // namespace cullet
