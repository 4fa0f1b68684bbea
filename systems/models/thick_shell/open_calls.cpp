#include "systems/models/thick_shell/open_calls.hpp"

#include "systems/bodies/blows.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/models/thick_shell/quick/costs.hpp"
#include "systems/models/thick_shell/quick/quick_cut_out.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/shared/working_room.hpp"
#include "systems/models/thick_shell/stiffness/costs.hpp"
#include "systems/structures/shell/costs.hpp"

namespace cullet {

WorkingCopy working_shell(BodyRows& state, Row<Bodies> body) {
    WorkingCopy made;
    made.waits = may_cut_out(state, body);
    if (made.waits) return made;
    const ShellView source(state, state.bodies.structure[body]);
    const ShellRoom room = is_quick_body(state, body) ? quick_room(source) : working_room(source);
    made.structure = make_shell_unclear(state, room, &made.full);
    return made;
}

void begin_run(BodyRows& state, Row<Tasks> task) {
    Tasks& tasks = state.tasks;
    const Row<Bodies> body = tasks.body[task];
    const Row<Structures> source = tasks.source[task];
    const uint32_t vertices = state.shells.vertices[state.shell_of(source)].count;
    const bool is_quick = is_quick_body(state, body), waits = !tasks.working[task].exists();
    set_task_times(state, task);
    set_quick_task(state, task, body);
    const bool is_assembled = is_quick || waits || state.shells.packs[state.shell_of(source)].count > 0;
    const uint64_t units = is_quick ? kUnitsQuickCopy : kUnitsOpen + (is_assembled ? 0 : kUnitsAssemble);
    if (!waits) tasks.units_owed[task] = vertices * units;
}

bool give_late_rows(BodyRows& state, const Blows& blows, Row<Tasks> task, const char** full) {
    Tasks& tasks = state.tasks;
    const bool is_everywhere = has_explosion(blows, task) || is_cut_task(blows, task);
    if (!is_quick_task(state, task))
        return give_hidden_rows(state, task, is_everywhere ? kNone : kWholeCopyVertices, full);
    const ShellView source(state, tasks.source[task]);
    CutOutResult result = CutOutResult::TooWide;
    if (!is_everywhere) result = reserve_cut_out(state, task, quick_cut_out_size(state, task), full);
    if (result == CutOutResult::TooWide) tasks.working[task] = make_shell_unclear(state, quick_room(source), full);
    const Row<Structures> working = tasks.working[task];
    if (!working.exists()) return false;
    tasks.units_owed[task] += result == CutOutResult::Reserved
                                  ? state.shells.vertices[state.shell_of(working)].count * kUnitsQuickOpen
                                  : source.vertex_count() * kUnitsQuickCopy;
    return true;
}

std::optional<RunLength> run_length(const BodyRows& state, Row<Bodies> body) {
    if (is_quick_body(state, body)) return {};
    const Row<Structures> shell = state.bodies.structure[body];
    const Row<Shells> row = state.shell_of(shell);
    return RunLength{run_seconds(state, state.structures.material[shell], state.structures.area[shell]),
                     state.shells.time_step[row], units_a_step(state.shells.vertices[row].count, 64)};
}

}  // namespace cullet
