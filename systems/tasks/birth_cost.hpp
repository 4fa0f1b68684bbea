#pragma once
#include "components/tasks.hpp"

namespace cullet {

// A vertex of a body whose pieces are born: rows, hulls, drawn meshes, and where one worker has it the waiting of the
// other. 3.1 microseconds over all breaks of scene demolition, 7 where 150 pieces leave a house at once.
inline constexpr uint64_t kUnitsBirth = 2500;  // of 2 ns of one thread

/// Units of what the last repetition of a run brings with it where something has cracked: pieces, hulls, drawn meshes.
/// `points`: of the task's structure, that are gone through. What was foreseen pays when it is touched.
inline uint64_t units_of_birth(const Tasks& tasks, uint32_t t, uint32_t points) {
    const bool has_cracked = tasks.crack_count[t] > 0 && !is_ahead(tasks, t);
    return has_cracked ? kUnitsBirth * points : 0;
}

}  // namespace cullet
