// What a hit costs, in units.
#pragma once
#include "components/state.hpp"
#include "systems/costs.hpp"

namespace cullet {

/// One repetition of the inner loop with its share of the checks.
inline uint64_t units_a_step(uint64_t vertex_count, uint64_t patch_vertex_count) {
    return vertex_count * kUnitsHiddenStep + vertex_count * kUnitsStressCheck / kStepsAStressCheck +
           vertex_count * kUnitsEnergyCheck / kStepsAnEnergyCheck + patch_vertex_count * kUnitsContactVertex + 100;
}
inline uint64_t units_a_step(const Shells& shells, const Tasks& tasks, uint32_t t) {
    return units_a_step(shells.vertices[tasks.shell[t]].count, 64 * tasks.contact_count[t]);
}

}  // namespace cullet
