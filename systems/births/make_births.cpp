#include "systems/births/make_break.hpp"
#include "systems/births/strike_back.hpp"
#include "systems/bodies/blows.hpp"
#include "systems/bodies/thresholds.hpp"
#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

void close_task(State& state, Row<Tasks> task, Step step) {
    Tasks& tasks = state.tasks;
    const Row<Bodies> body = tasks.body[task];
    state.bodies.task[body] = kNone;
    state.bodies.retry_frame[body] = step.frame + retry_frames(step.dt);
    if (tasks.shell[task].exists()) release_shell(state, tasks.shell[task]);
    release_shell(state, tasks.source[task]);
    tasks.state[task] = static_cast<uint8_t>(TaskState::Free);
}

// A body that was whole and broke by touch alone: whether in the very frame of the touch.
void count_first_break(const State& state, Row<Tasks> task, Step step, DamageCounts& counts) {
    const Tasks& tasks = state.tasks;
    const Blows& blows = state.blows;
    if (static_cast<TaskState>(tasks.state[task]) != TaskState::Broke) return;
    if (state.shells.generation[tasks.source[task]] > 0) return;
    for (uint32_t b = 0; b < blows.size(); ++b)
        if (blows.task[b] == task.index) return;
    ++counts.first_breaks;
    counts.first_ready += tasks.opened_frame[task] == step.frame;
}

void count_result(const Tasks& tasks, Row<Tasks> task, DamageCounts& counts) {
    const auto result = static_cast<TaskState>(tasks.state[task]);
    counts.broke += result == TaskState::Broke;
    counts.late += result == TaskState::Broke && tasks.is_late[task];
    counts.whole += result == TaskState::Whole;
    counts.dropped += result == TaskState::Dropped;
    counts.cuts += tasks.crack_count[task];
    counts.starts += tasks.start_count[task];
    counts.redone += tasks.redo_count[task];
}

}  // namespace

void make_births(Serial, Step step, const Events<TaskEnded>& ended, const Events<Break>& breaks, ShellTables shells,
                 Tasks& tasks, TaskContacts& contacts, Blows& blows, Bodies& bodies, Debris&, FragmentAges&,
                 DebrisAges&, RigidWorld& rigid, DamageCounts& counts, Arena& arena, Events<ShellChanged>& changed,
                 Events<FragmentBornEvent>& born, Events<DebrisEvent>& debris_events) {
    Births births{shells.state, rigid, counts, arena, changed, born, debris_events, step};
    const auto all = breaks.all();
    size_t next = 0;
    while (next < all.size() && !all[next].task.exists()) make_break(births, all[next++]);
    for (const TaskEnded& e : ended) {
        count_first_break(shells.state, e.task, step, counts);
        count_result(tasks, e.task, counts);
        if (next < all.size() && all[next].task == e.task) make_break(births, all[next++]);
        pay_answers(bodies, tasks, contacts, rigid, e.task);
        close_blows(blows, bodies, tasks, rigid, counts, e.task);
        close_task(shells.state, e.task, step);
    }
}

}  // namespace cullet
