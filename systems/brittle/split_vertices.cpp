#include "systems/damage/contact.hpp"
#include "systems/damage/grow_cracks.hpp"
#include "systems/systems.hpp"

namespace cullet {

void split_vertices(EachBody task, ShellTables shells, Tasks& tasks, TaskContacts&, PatchVertices&) {
    const Row<Tasks> t(task.row);
    if (static_cast<TaskState>(tasks.state[t]) != TaskState::Running) return;
    CrackSink sink;
    const uint32_t cuts = grow_cracks(shells.state, t, sink);
    if (sink.is_out_of_slots) tasks.state[t] = static_cast<uint8_t>(TaskState::Dropped);
    if (cuts > 0) build_patches(shells.state, t);  // weights follow the masses that the cuts shared out
}

}  // namespace cullet
