// The inner loop of metal shells, and what a run of it costs.
#pragma once
#include "systems/model_loops.hpp"

namespace cullet::metal_shell {

inline constexpr float kStep = 1e-3f;  // s of the run's clock: an impact is one step

InnerLoop<TaskWorld> make_loop();

RunCost cost_of(Read<MetalRows> rows, uint32_t task);
bool works_on(Read<MetalRows> rows, uint32_t task);

}  // namespace cullet::metal_shell
