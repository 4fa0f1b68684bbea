#include <algorithm>

#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

/// What cuts have left of the frame's units is enough for the last step and for what is born then.
bool may_end(PassedTables state, Row<Tasks> task) {
    const uint64_t a_step = units_a_step(state, task);
    return state.tasks.steps_granted[task] * a_step >= a_step + units_of_birth(state, task);
}

}  // namespace

// A run ends after T, or after a quiet time since the last crack or touch; contact chatters, so T usually ends it.
void pass_impulses(Of<Tasks> task, Turn turn, PassedTables rows) {
    const Row<Tasks> t = task.row;
    if (is_hidden_region(rows, t)) move_rest(rows, t, turn.old_side);
    apply_contact(rows, t, turn.old_side);
    rows.tasks.steps_granted[t] -= rows.tasks.steps_granted[t] > 0;
    const float end =
        std::min(rows.hidden_runs.end_time[t], rows.hidden_runs.last_event_time[t] + rows.hidden_runs.quiet_time[t]);
    const auto time_at = [&](uint32_t steps) { return static_cast<float>(steps) * rows.hidden_runs.time_step[t]; };
    const uint32_t done = ++rows.tasks.steps_done[t];
    if (time_at(done) > end)
        rows.tasks.state[t] = static_cast<uint8_t>(TaskState::Whole);  // find_parts tells whether it broke
    else if (time_at(done + 1) > end && !may_end(rows, t))
        rows.tasks.steps_granted[t] = 0;
}

}  // namespace cullet
