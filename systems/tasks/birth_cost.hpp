#pragma once
#include "components/run_rows.hpp"
#include "systems/costs.hpp"

namespace cullet {

/// Units of what the last repetition of a run brings with it where something has cracked: pieces, hulls, drawn meshes.
/// What was foreseen pays when it is touched.
inline uint64_t units_of_birth(const RunRows& rows, uint32_t t) {
    const Tasks& tasks = rows.tasks;
    const bool has_cracked = tasks.crack_count[t] > 0 && !is_ahead(tasks, t);
    return has_cracked ? kUnitsBirth * rows.shells.vertices[rows.shell_of(tasks.working[t])].count : 0;
}

}  // namespace cullet
