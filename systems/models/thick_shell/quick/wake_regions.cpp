// Regions of the quick mode wake before the loop; those and hidden ones are closed behind it.
#include "components/body_id.hpp"
#include "systems/models/thick_shell/hidden/forget_run.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/hidden/run_out.hpp"
#include "systems/models/thick_shell/quick/costs.hpp"
#include "systems/models/thick_shell/quick/region_motion.hpp"
#include "systems/models/thick_shell/quick/systems.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/structures/shell/flood_parts.hpp"

namespace cullet {
namespace {

// What find_parts does for whole shells: cracks run out where something came free. Parts are not numbered: the numbers
// say which elements of the body the cut-out has.
void run_out_region(RunRows& state, Row<Tasks> task) {
    if (static_cast<TaskState>(state.tasks.state[task]) == TaskState::Dropped) return;
    if (state.tasks.crack_count[task] == 0) return;
    const Scratch<FloodedParts> found(state.scratch);
    flood_parts(ShellView(state, state.tasks.working[task]), *found);
    if (found->pieces > 0) run_out_cracks(state, task);
}

bool is_woken(const RunRows& state, Row<Tasks> task) {
    return is_quick_task(state, task) && static_cast<TaskState>(state.tasks.state[task]) == TaskState::Running;
}

}  // namespace

// One after another: rows of springs come from pools.
void wake_regions(Serial, Own<TaskOpened> opened, RunRows& rows, const Bodies& bodies, Events<RegionPart>& parts,
                  Events<RefusedEvent>& refused) {
    parts.clear();
    for (const TaskOpened& o : opened) {
        if (!is_woken(rows, o.task)) continue;
        const char* full = "";
        if (!wake_region(rows, o.task, &full)) {
            refused.push(refused_event(bodies, rows.tasks.body[o.task], full));
            continue;
        }
        const uint64_t units = rows.quick_runs.layers[o.task] > 1 ? kUnitsQuickWakeTwo : kUnitsQuickWake;
        rows.tasks.units_owed[o.task] += rows.quick_runs.awake_count[o.task] * units;
        const uint32_t first = o.task * kMostMarkedPacks, count = rows.hidden_runs.pack_count[o.task];
        for (uint32_t row = first; row < first + count; row += kRowsPerChunk<MarkedPacks>) parts.push({o.task, row});
    }
}

void measure_regions(Each<RegionPart> part, RunRows& rows) {
    measure_region_springs(RegionView(rows, part->task), part->first_row);
}

void lay_regions(Each<RegionPart> part, RunRows& rows) {
    lay_region_springs(RegionView(rows, part->task), part->first_row);
}

void start_regions(Serial, Own<TaskOpened> opened, RunRows& rows, const Blows& blows) {
    for (const TaskOpened& o : opened)
        if (is_woken(rows, o.task)) start_region(rows, blows, o.task);
}

void close_regions(Serial, Own<TaskEnded> ended, BodyRows& rows, Events<CrackStartedEvent>& cracks) {
    for (const TaskEnded& e : ended) {
        if (static_cast<TaskState>(rows.tasks.state[e.task]) == TaskState::Dropped) forget_run(rows, e.task);
        if (is_hidden_region(rows, e.task)) {
            run_out_region(rows, e.task);
            put_back(rows, e.task, rest_motion(rows, e.task), cracks);
        }
        if (!is_quick_task(rows, e.task)) continue;
        const BodyMotion motion(rows, e.task);  // a pass over the body
        close_region(rows, e.task, motion);
        if (is_cut_out(rows, e.task)) put_back(rows, e.task, motion, cracks);
    }
}

}  // namespace cullet
