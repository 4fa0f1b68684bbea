// Its inner loop, and what a run of it costs.
#pragma once
#include "systems/model_loops.hpp"

namespace cullet::halves {

inline constexpr float kStep = 1.0f / 1024, kEnd = 7 * kStep;  // s; 8 steps

InnerLoop<TaskWorld> make_loop();

RunCost cost_of(const RunRows& rows, uint32_t task);
bool works_on(const RunRows& rows, uint32_t task);

}  // namespace cullet::halves
