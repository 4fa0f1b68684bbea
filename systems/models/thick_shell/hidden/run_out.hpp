// Cracks that stopped short go on when the body has come apart.
#pragma once
#include "components/run_rows.hpp"

namespace cullet {

/// For a run whose body is in pieces. A crack tip that has a border or a crack ahead, within 15 degrees of its heading
/// or else within 35, goes on straight to it. It has to be nearer than the material's `run_out` times the crack's own
/// length (three mean edges at least). What holds such a ligament in the model is that the run is over; in a wall that
/// falls, its pieces' weight breaks it. Tips without such an end stay where they are, as hairlines. Masses and
/// velocities are kept as by every cut. Tips in order of their rows; O(tips x vertices), all in the frame in which the
/// run ends: no units are asked for. Returns whether the mesh is another now. A vertex may come on an edge that is not
/// cut after all, and its elements belong to no part that was found before.
bool run_out_cracks(RunRows& state, Row<Tasks> task);

}  // namespace cullet
