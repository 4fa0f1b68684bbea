// From which hit on a cooked shell cracks, and how much work a hit on it is.
#pragma once
#include "components/run_rows.hpp"
#include "cullet/model.hpp"
#include "systems/cook/cooking.hpp"

namespace cullet {

/// Of a hit: above this a threshold is estimated, since measuring it would take minutes (a wall of 1,600 stones takes
/// half of that).
inline constexpr uint64_t kMostMeasuredUnits = 2'000'000'000;

/// Of a large body whose cracks stay near the hit those of the part that it begins on.
uint64_t units_of_a_hit(const RunRows& state, Row<Structures> shell);
/// Writes first_crack_speed and first_crack_force: of hits at some places, and what is left of the progress is told
/// from 0.4 on.
void measure_thresholds(RunRows& state, Row<Structures> shell, const Cooking& from);
/// Of the material alone; 0 of what does not crack.
void estimate_thresholds(RunRows& state, Row<Structures> shell);

}  // namespace cullet
