#include "systems/models/thick_shell/hidden/restart.hpp"

#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/models/thick_shell/hidden/crack_candidates.hpp"
#include "systems/models/thick_shell/hidden/grow_cracks.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/hidden/start_explosions.hpp"
#include "systems/models/thick_shell/hidden/start_hidden.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/models/thick_shell/shared/forget_cracks.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/models/thick_shell/stiffness/element_stress.hpp"
#include "systems/structures/shell/struck_normal.hpp"

namespace cullet {
namespace {

void find_contact_vertices(RunRows& state, Row<Tasks> task) {
    const ShellView shell(state, state.tasks.working[task]);
    TaskContacts& contacts = state.task_contacts;
    const uint32_t first = state.tasks.first_contact[task];
    for (uint32_t c = first; c < first + state.tasks.contact_count[task]; ++c) {
        const uint32_t nearest = nearest_vertex(shell, contacts.point[c]);
        if (nearest != kNone) contacts.vertex[c] = nearest;
    }
}

}  // namespace

// Springs, hinges and their scales are those of the run that broke it off, which kept them up to date.
void fill_task(RunRows& state, Row<Tasks> task) {
    Tasks& tasks = state.tasks;
    const Row<Structures> source = tasks.source[task], working = tasks.working[task];
    if (is_hidden_region(state, task)) {
        fill_cut_out(state, task);
        find_rest(state, task);
        const ShellView cut(state, working);
        begin_cracks(cut, state.structures.generation[source] > 0);
        if (!lay_packs(cut)) tasks.state[task] = static_cast<uint8_t>(TaskState::Dropped);
        return;
    }
    if (is_cut_out(state, task)) return fill_cut_out(state, task);
    if (is_quick_task(state, task)) {
        copy_shell_rows(state, state, source, working, false);
        clear_pack_ends(state, working);
        return forget_cracks(ShellView(state, working), state.structures.generation[source] > 0);
    }
    const bool is_assembled = state.shells.packs[state.shell_of(source)].count > 0;
    copy_shell_rows(state, state, source, working, is_assembled);
    clear_pack_ends(state, working);
    const ShellView shell(state, working);
    begin_cracks(shell, state.structures.generation[source] > 0);
    if (!is_assembled && !lay_packs(shell)) tasks.state[task] = static_cast<uint8_t>(TaskState::Dropped);
}

void start_run(RunRows& state, const Blows& blows, Row<Tasks> task) {
    find_contact_vertices(state, task);
    if (is_quick_task(state, task)) return;  // wake_regions does the rest
    build_patches(state, task);
    state.hidden_runs.last_event_time[task] = 0;
    state.tasks.crack_count[task] = state.tasks.start_count[task] = 0;
    state.tasks.lacks_room[task] = 0;
    start_hidden(state, task);
    start_explosions(state, blows, task);
}

void restore_scratch(RunRows& state, Row<Tasks> task) {
    if (is_cut_out(state, task)) remember_cut_out(state, task);
    if (is_quick_task(state, task)) return;
    const ShellView shell(state, state.tasks.working[task]);
    link_slopes(shell);
    find_start_strengths(shell);
}

void start_task(RunRows& state, const Blows& blows, Row<Tasks> task) {
    if (is_cut_out(state, task) && state.hidden_runs.redo_count[task] > 0) list_cut_out(state, task);
    fill_task(state, task);
    const ShellView shell(state, state.tasks.working[task]);
    const bool is_assembled =
        state.shells.packs[state.shell_of(state.tasks.source[task])].count > 0 && !is_cut_out(state, task);
    if (!is_assembled && static_cast<TaskState>(state.tasks.state[task]) != TaskState::Dropped)
        assemble_packs(shell, 0, shell.shells().packs[shell.row].count);
    start_run(state, blows, task);
}

}  // namespace cullet
