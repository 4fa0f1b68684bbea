// Which tasks all workers share.
#pragma once
#include "components/run_rows.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"

namespace cullet {

/// Vertices that a repetition moves: of a quick run those of its region.
inline uint32_t moving_vertices(const RunRows& state, uint32_t t) {
    return is_quick_task(state, t) ? kLanes * state.quick_runs.pack_count[t]
                                   : state.shells.vertices[state.tasks.shell[t]].count;
}

}  // namespace cullet
