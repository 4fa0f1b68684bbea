// What a task costs, and which tasks all workers share.
#pragma once
#include "components/run_rows.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/models/thick_shell/quick/quick_loop.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"

namespace cullet {

/// Units.
struct TaskCost {
    uint64_t step = 0;
    uint64_t end = 0;  // what follows the last step
};
inline TaskCost task_cost(const RunRows& rows, uint32_t t) {
    if (is_quick_task(rows, t)) return {quick_units_a_step(rows, t), quick_units_of_end(rows, t)};
    return {units_a_step(rows.shells, rows.tasks, t), units_of_birth(rows.shells, rows.tasks, t)};
}

/// Vertices that a repetition moves: of a quick run those of its region.
inline uint32_t moving_vertices(const RunRows& rows, uint32_t t) {
    return is_quick_task(rows, t) ? kLanes * rows.quick_runs.pack_count[t]
                                  : rows.shells.vertices[rows.tasks.shell[t]].count;
}

}  // namespace cullet
