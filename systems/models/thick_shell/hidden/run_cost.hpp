// What hidden runs cost, in units.
#pragma once
#include "components/run_rows.hpp"
#include "systems/models/thick_shell/hidden/costs.hpp"
#include "systems/structures/shell/costs.hpp"
#include "systems/tasks/birth_cost.hpp"

namespace cullet {

/// One repetition of the inner loop with its share of the checks.
inline uint64_t units_a_step(uint64_t vertex_count, uint64_t patch_vertex_count) {
    return vertex_count * kUnitsHiddenStep + vertex_count * kUnitsStressCheck / kStepsAStressCheck +
           vertex_count * kUnitsEnergyCheck / kStepsAnEnergyCheck + patch_vertex_count * kUnitsContactVertex + 100;
}
inline uint64_t units_a_step(Tables<const Structures, const Shells, const Tasks> rows, uint32_t t) {
    const Tasks& tasks = rows.tasks;
    return units_a_step(rows.shells.vertices[shell_of(rows.structures, tasks.working[t])].count,
                        64 * tasks.contact_count[t]);
}

inline uint64_t units_of_birth(Tables<const Structures, const Shells, const Tasks> rows, uint32_t t) {
    return units_of_birth(rows.tasks, t, rows.shells.vertices[shell_of(rows.structures, rows.tasks.working[t])].count);
}

/// The hidden run of a shell of more vertices is one that all workers share. Below it they wait for each other as long
/// as they save: of 1,000 to 2,300 vertices two take as long as one, of 3,200 they are 1.4 times as fast, of 11,000
/// twice.
inline constexpr uint32_t kTeamVertices = 2500;

/// An edge that a crack cuts: a larger shell's rows are farther apart (20 microseconds of 100 vertices, 36 of 2,000),
/// and where workers share the run the others wait meanwhile. Ahead of its touch a hit is charged half of that at most:
/// nothing is born in those frames, and what is not ready at the touch is seen to wait.
inline uint64_t units_of_crack(uint64_t vertex_count, bool is_ahead) {
    const bool is_shared = vertex_count > kTeamVertices;
    const uint64_t size = is_ahead ? 0 : is_shared ? kTeamVertices : vertex_count;
    return (is_shared ? 2 : 1) * (kUnitsCut + kUnitsCut * size / 2000);
}

}  // namespace cullet
