#pragma once
#include "components/run_rows.hpp"
#include "systems/costs.hpp"
#include "systems/structure_calls.hpp"

namespace cullet {

/// Units of what follows where a task's structure comes apart, by what there is of it.
inline uint64_t units_of_pieces(const RunRows& rows, uint32_t t) {
    const Row<Structures> working = rows.tasks.working[t];
    return kUnitsBirth * calls_of(rows.structures, working).points_at_birth(rows, working);
}

/// Units of what the last repetition of a run brings with it where something has cracked: pieces, hulls, drawn meshes.
/// What was foreseen pays when it is touched.
inline uint64_t units_of_birth(const RunRows& rows, uint32_t t) {
    const Tasks& tasks = rows.tasks;
    const bool has_cracked = tasks.crack_count[t] > 0 && !is_ahead(tasks, t);
    return has_cracked ? units_of_pieces(rows, t) : 0;
}

}  // namespace cullet
