#include "systems/models/thick_shell/shared/cancel_run.hpp"

#include "systems/models/thick_shell/shared/quick_body.hpp"

namespace cullet {

void cancel_run(RunRows& state, Row<Tasks> task) {
    QuickRuns& runs = state.quick_runs;
    if (is_quick_task(state, task)) {
        runs.springs[task] = {};
        runs.pack_count[task] = 0;
        state.awake_packs.clear_rows(task * kMostAwakePacks, kMostAwakePacks);
    }
    if (task < runs.size()) runs.cut_elements[task] = 0;
}

}  // namespace cullet
