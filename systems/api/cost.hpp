// What a world costs, and its fragments in the order in which they go.
#pragma once
#include <vector>

#include "cullet/world.hpp"
#include "systems/world_data.hpp"

namespace cullet {

/// Rows of all fragments, the oldest first, those of one frame by row.
std::vector<Row<Bodies>> fragments_by_age(const State& state);

/// What waits and what was retired.
void report_cost(const WorldData& d, StepReport& report);

}  // namespace cullet
