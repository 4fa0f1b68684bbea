#include <algorithm>

#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/models/thick_shell/hidden/grow_cracks.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

// By steps that are granted and will not be run in this frame; what is left is owed, and taken from the next grant.
// Owed whole, explosions in houses cut for a second budget in the frame that spent its own on steps.
void pay_cuts(State& state, Row<Tasks> task) {
    Tasks& tasks = state.tasks;
    const uint64_t a_step = units_a_step(state.shells, tasks, task);
    const uint64_t steps = std::min<uint64_t>(tasks.steps_granted[task], tasks.units_owed[task] / a_step);
    tasks.steps_granted[task] -= static_cast<uint32_t>(steps);
    tasks.units_owed[task] -= steps * a_step;
}

}  // namespace

void split_vertices(EachBody task, ShellTables shells, Tasks& tasks, TaskContacts&, PatchVertices&) {
    const Row<Tasks> t(task.row);
    if (static_cast<TaskState>(tasks.state[t]) != TaskState::Running) return;
    const bool was_whole = tasks.crack_count[t] == 0;
    CrackSink sink;
    const uint32_t cuts = grow_cracks(shells.state, t, sink);
    if (sink.is_at_border) {  // it goes no further; widen_regions begins it again
        shells.state.region_rests.wants_more[t] = 1;
        tasks.steps_granted[t] = 0;
        return;
    }
    if (was_whole && cuts > 0 && is_hidden_region(shells.state, t)) bear_more(shells.state, t);
    if (sink.refused > 0) tasks.lacks_room[t] = 1;
    if (sink.is_out_of_slots) tasks.state[t] = static_cast<uint8_t>(TaskState::Dropped);
    if (cuts > 0) {
        pay_cuts(shells.state, t);
        build_patches(shells.state, t);  // weights follow the masses that the cuts shared out
    }
}

}  // namespace cullet
