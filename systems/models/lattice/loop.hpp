// The inner loop of solids, and what a run of it costs.
#pragma once
#include "systems/model_loops.hpp"

namespace cullet::lattice {

inline constexpr float kStep = 1e-3f;             // s of the run's clock, which counts steps alone
inline constexpr uint64_t kUnitsAStep = 100'000;  // 0.2 ms of assembling, factoring or stress, at most
inline constexpr uint32_t kMostSteps = 4096;      // of a run: it ends when it is done, which nobody knows before

InnerLoop<TaskWorld> make_loop();

RunCost cost_of(Read<LatticeRows> rows, uint32_t task);
bool works_on(Read<LatticeRows> rows, uint32_t task);

}  // namespace cullet::lattice
