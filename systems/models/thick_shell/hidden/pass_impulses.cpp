#include <algorithm>

#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/models/thick_shell/hidden/systems.hpp"
#include "systems/models/thick_shell/shared/count_step.hpp"

namespace cullet {

// A run ends after T, or after a quiet time since the last crack or touch; contact chatters, so T usually ends it.
void pass_impulses(Of<Tasks> task, Turn turn, PassedTables rows) {
    const Row<Tasks> t = task.row;
    if (is_hidden_region(rows, t)) move_rest(rows, t, turn.old_side);
    apply_contact(rows, t, turn.old_side);
    const float end =
        std::min(rows.hidden_runs.end_time[t], rows.hidden_runs.last_event_time[t] + rows.hidden_runs.quiet_time[t]);
    count_step(rows.tasks, rows.hidden_runs, t, end, [&] {
        return StepUnits{units_a_step(rows, t), units_of_birth(rows, t)};
    });
}

}  // namespace cullet
