#include <algorithm>

#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/models/thick_shell/hidden/grow_cracks.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/models/thick_shell/hidden/systems.hpp"

namespace cullet {
namespace {

// By steps that are granted and will not be run in this frame; what is left is owed, and taken from the next grant.
// Owed whole, explosions in houses cut for a second budget in the frame that spent its own on steps.
void pay_cuts(RunRows& state, Row<Tasks> task) {
    Tasks& tasks = state.tasks;
    const uint64_t a_step = units_a_step(state, task);
    const uint64_t steps = std::min<uint64_t>(tasks.steps_granted[task], tasks.units_owed[task] / a_step);
    tasks.steps_granted[task] -= static_cast<uint32_t>(steps);
    tasks.units_owed[task] -= steps * a_step;
}

}  // namespace

void split_vertices(Of<Tasks> task, RunRows& rows) {
    const Row<Tasks> t = task.row;
    if (static_cast<TaskState>(rows.tasks.state[t]) != TaskState::Running) return;
    const bool was_whole = rows.tasks.crack_count[t] == 0;
    CrackSink sink;
    const uint32_t cuts = grow_cracks(rows, t, sink);
    if (sink.is_at_border) {  // it goes no further; widen_regions begins it again
        rows.region_rests.wants_more[t] = 1;
        rows.tasks.steps_granted[t] = 0;
        return;
    }
    if (was_whole && cuts > 0 && is_hidden_region(rows, t)) bear_more(rows, t);
    if (sink.refused > 0) rows.tasks.lacks_room[t] = 1;
    if (sink.is_out_of_slots) rows.tasks.state[t] = static_cast<uint8_t>(TaskState::Dropped);
    if (cuts > 0) {
        pay_cuts(rows, t);
        build_patches(rows, t);  // weights follow the masses that the cuts shared out
    }
}

}  // namespace cullet
