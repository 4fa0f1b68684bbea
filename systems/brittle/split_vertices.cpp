#include "systems/brittle/hidden_region.hpp"
#include "systems/costs.hpp"
#include "systems/damage/contact.hpp"
#include "systems/damage/grow_cracks.hpp"
#include "systems/systems.hpp"

namespace cullet {

void split_vertices(EachBody task, ShellTables shells, Tasks& tasks, TaskContacts&, PatchVertices&) {
    const Row<Tasks> t(task.row);
    if (static_cast<TaskState>(tasks.state[t]) != TaskState::Running) return;
    const bool was_whole = tasks.crack_count[t] == 0;
    const uint64_t owed_before = tasks.units_owed[t];
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
    if (owed_before < kMostUnitsOwed && tasks.units_owed[t] >= kMostUnitsOwed) tasks.steps_granted[t] = 0;
    if (cuts > 0) build_patches(shells.state, t);  // weights follow the masses that the cuts shared out
}

}  // namespace cullet
