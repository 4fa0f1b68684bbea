#include "systems/damage/run_out.hpp"
#include "systems/fragments/group_fragments.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

/// By the numbers of the last grouping: cooking's, or that of the break that made the shell.
bool is_of_one_part(ShellView shell) {
    const Elements& elements = shell.state.elements;
    uint32_t part = kNone;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        if (elements.flags[row] & kDead) continue;
        if (part == kNone) part = elements.part[row];
        if (elements.part[row] != part) return false;
    }
    return true;
}

}  // namespace

// A mesh of several parts, which nothing but the rigid body held together, comes apart at the first hit that is worth a
// task, cracked or not.
void find_parts(Each<TaskEnded> ended, ShellTables shells, Tasks& tasks, Fragments& fragments) {
    const uint32_t t = ended->task;
    tasks.part_count[t] = 1;
    if (static_cast<TaskState>(tasks.state[t]) == TaskState::Dropped) return;
    const ShellView shell(shells.state, tasks.shell[t]);
    if (tasks.crack_count[t] == 0 && is_of_one_part(shell)) return;
    const std::span parts(fragments.part.data() + size_t{t} * kMostParts, kMostParts);
    tasks.part_count[t] = group_fragments(shell, parts);
    if (tasks.part_count[t] > 1 && run_out_cracks(shells.state, Row<Tasks>(t)) > 0)
        tasks.part_count[t] = group_fragments(shell, parts);
    if (tasks.part_count[t] > 1) tasks.state[t] = static_cast<uint8_t>(TaskState::Broke);
    if (tasks.part_count[t] > kMostParts) tasks.state[t] = static_cast<uint8_t>(TaskState::Dropped);
}

}  // namespace cullet
