// What hits and cuts cost, in units.
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

/// The hidden run of a shell of more vertices is one that all workers share.
inline constexpr uint32_t kTeamVertices = 1000;
/// An edge that a crack cuts: where workers share the run the others wait meanwhile.
inline uint64_t units_of_crack(uint64_t vertex_count) {
    return vertex_count > kTeamVertices ? 2 * kUnitsCut : kUnitsCut;
}

/// What a cut of the game looks at: the whole shell, for every segment of its line. Its task's opening is not in it.
inline uint64_t units_of_cut(const Shells& shells, Row<Shells> shell, const Blows& blows, uint32_t row) {
    const uint32_t points = blows.point_count[row];
    return shells.elements[shell].count * kUnitsCutElement * (points > 2 ? points - 1 : 1);
}

}  // namespace cullet
