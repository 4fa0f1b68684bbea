#pragma once
#include "components/shells.hpp"
#include "components/tasks.hpp"
#include "systems/costs.hpp"

namespace cullet {

/// Units of what the last repetition of a run brings with it where something has cracked: pieces, hulls, drawn meshes.
/// What was foreseen pays when it is touched.
inline uint64_t units_of_birth(const Shells& shells, const Tasks& tasks, uint32_t t) {
    const bool has_cracked = tasks.crack_count[t] > 0 && !is_ahead(tasks, t);
    return has_cracked ? kUnitsBirth * shells.vertices[tasks.shell[t]].count : 0;
}

}  // namespace cullet
