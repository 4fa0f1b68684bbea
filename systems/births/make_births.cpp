#include <algorithm>

#include "systems/births/make_break.hpp"
#include "systems/births/strike_back.hpp"
#include "systems/bodies/blows.hpp"
#include "systems/bodies/thresholds.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

// Whether blows are worked off in one piece, in the frame of their touch.
bool is_brief(const DamageModels& models, const WorldRows& state, Row<Tasks> task) {
    const auto& loops = models[state.model_of(task)].task_loops();
    return std::all_of(loops.begin(), loops.end(), [](const TaskLoop& loop) { return loop.is_brief(); });
}

// A brief blow keeps nobody waiting: its model knows by itself what is more of the same one. A shot that hit a sheet in
// the three frames after a shard had scraped it, or after another shot, bounced. A press waits: it goes on in any case,
// and a box that was dented by it in each frame was tipped over and lay 15 mm deep in the floor for a frame.
void close_task(WorldRows& state, const DamageModels& models, Row<Tasks> task, Step step) {
    Tasks& tasks = state.tasks;
    const Row<Bodies> body = tasks.body[task];
    state.bodies.task[body] = kNone;
    const bool waits = tasks.load[task] > 0 || !is_brief(models, state, task);
    state.bodies.retry_frame[body] = step.frame + (waits ? retry_frames(step.dt) : 0);
    const StructureCalls& calls = calls_of(state.structures, tasks.source[task]);
    if (tasks.working[task].exists()) calls.release(state, tasks.working[task]);
    calls.release(state, tasks.source[task]);
    tasks.state[task] = static_cast<uint8_t>(TaskState::Free);
}

// A body that was whole and broke by touch alone: whether in the very frame of the touch.
void count_first_break(const RunRows& state, const Blows& blows, Row<Tasks> task, Step step, DamageCounts& counts) {
    const Tasks& tasks = state.tasks;
    if (static_cast<TaskState>(tasks.state[task]) != TaskState::Broke) return;
    if (state.structures.generation[tasks.source[task]] > 0) return;
    for (uint32_t b = 0; b < blows.size(); ++b)
        if (blows.task[b] == task.index) return;
    ++counts.first_breaks;
    counts.first_ready += tasks.opened_frame[task] == step.frame;
}

void count_result(const RunRows& rows, Row<Tasks> task, DamageCounts& counts) {
    const Tasks& tasks = rows.tasks;
    const auto result = static_cast<TaskState>(tasks.state[task]);
    counts.broke += result == TaskState::Broke;
    counts.late += result == TaskState::Broke && tasks.is_late[task];
    counts.whole += result == TaskState::Whole || result == TaskState::Reshaped;
    counts.dropped += result == TaskState::Dropped;
    counts.cuts += tasks.crack_count[task];
    counts.starts += tasks.start_count[task];
    counts.redone += rows.hidden_runs.redo_count[task];
}

}  // namespace

void make_births(Serial, Step step, EndedTasks over, WorldRows& rows, Blows& blows, DebrisTables debris_tables,
                 RigidWorld& rigid, BirthAccounts accounts, ToldOfBirths told) {
    Births births{rows,
                  over.fragments,
                  over.touches,
                  blows,
                  debris_tables.debris,
                  debris_tables.ages,
                  rigid,
                  accounts.models,
                  accounts.counts,
                  accounts.arena,
                  told.changed,
                  told.born,
                  told.debris,
                  step};
    const auto all = over.breaks.all();
    size_t next = 0;
    while (next < all.size() && !all[next].task.exists()) make_break(births, all[next++]);
    for (const TaskEnded& e : over.ended) {
        count_first_break(rows, blows, e.task, step, accounts.counts);
        count_result(rows, e.task, accounts.counts);
        if (next < all.size() && all[next].task == e.task) make_break(births, all[next++]);
        pay_answers(rows.bodies, rows.tasks, rows.task_contacts, rigid, e.task);
        close_blows(blows, rows.bodies, rows.tasks, rigid, accounts.counts, e.task);
        close_task(rows, accounts.models, e.task, step);
    }
    over.fragments.truncate(0);
    over.touches.truncate(0);
}

}  // namespace cullet
