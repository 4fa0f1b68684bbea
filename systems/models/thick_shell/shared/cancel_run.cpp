#include "systems/models/thick_shell/shared/cancel_run.hpp"

#include "systems/models/thick_shell/shared/quick_body.hpp"

namespace cullet {

void cancel_run(RunRows& state, Row<Tasks> task) {
    if (is_quick_task(state, task)) {
        state.quick_runs.springs[task] = {};
        state.hidden_runs.pack_count[task] = 0;
        state.marked_packs.clear_rows(task * kMostMarkedPacks, kMostMarkedPacks);
    }
    state.hidden_runs.cut_elements[task] = 0;
}

}  // namespace cullet
