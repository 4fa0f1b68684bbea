// How much of a large body a quick run works on.
#pragma once
#include "systems/models/thick_shell/shared/cut_out.hpp"

namespace cullet {

/// All that the region of a task can wake, and so many rings round it that no cut changes the outermost elements.
CutOutSize quick_cut_out_size(const RunRows& state, Row<Tasks> task);

}  // namespace cullet
