#include "systems/tasks/damage_loop.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "systems/models/thick_shell/quick/quick_loop.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/systems.hpp"
#include "systems/tasks/task_cost.hpp"

namespace cullet {

DamageLoop::DamageLoop(JobSystem& jobs, Profiler& profiler)
    : jobs_(jobs),
      profiler_(profiler),
      brittle_(make_brittle_loop()),
      quick_(make_quick_loop()),
      zone_(profiler.add_zone("damage task")) {}

namespace {

constexpr uint32_t kMostTasks = 1024;

struct Work {
    uint32_t task, vertices;
    uint64_t units;
};

uint64_t units_of_step(const RunRows& state, uint32_t t) {
    return is_quick_task(state, t) ? quick_units_a_step(state, t) : units_a_step(state.shells, state.tasks, t);
}

/// What a run that has ended brings with it in this frame, paid before it.
uint64_t units_of_end(const RunRows& state, uint32_t t) {
    if (static_cast<TaskState>(state.tasks.state[t]) == TaskState::Running) return 0;
    return is_quick_task(state, t) ? quick_units_of_end(state, t) : units_of_birth(state.shells, state.tasks, t);
}

/// Time that workers need who take one after the other.
uint64_t makespan(std::span<const Work> works, uint32_t workers) {
    uint64_t busy[64] = {};
    const uint32_t count = std::min<uint32_t>(workers, std::size(busy));
    for (const Work& work : works) *std::min_element(busy, busy + count) += work.units;
    return *std::max_element(busy, busy + count);
}

/// How many of the works, longest first, all workers should share: those that would keep one at work when the others
/// have nothing left. Who shares waits at each barrier: two workers do in six tenths of the time what one does.
uint32_t shared_works(std::span<const Work> works, uint32_t workers) {
    uint32_t best = 0;
    uint64_t shared = 0, least = makespan(works, workers);
    for (uint32_t count = 1; count <= std::min<size_t>(works.size(), workers); ++count) {
        if (works[count - 1].vertices <= kTeamVertices) break;
        shared += works[count - 1].units * 6 / (5 * workers);
        const uint64_t time = shared + makespan(works.subspan(count), workers);
        if (time < least) least = time, best = count;
    }
    return best;
}

}  // namespace

uint64_t DamageLoop::advance(RunRows& state, const Blows& blows) {
    LoopWorld world{state, blows};
    const Tasks& tasks = state.tasks;
    const Scratch<std::array<Work, kMostTasks>> list(state.scratch);
    Work* const works = list->data();
    uint32_t count = 0;
    for (uint32_t t = 0; t < tasks.size() && count < kMostTasks; ++t) {
        if (static_cast<TaskState>(tasks.state[t]) != TaskState::Running || tasks.steps_granted[t] == 0) continue;
        // More is granted than there are steps left: for cuts.
        const uint32_t steps = std::min(tasks.steps_granted[t], std::max(1u, steps_left(tasks, t, 0)));
        works[count++] = {t, moving_vertices(state, t), steps * units_of_step(state, t)};
    }
    std::sort(works, works + count,
              [](const Work& a, const Work& b) { return a.units != b.units ? a.units > b.units : a.task < b.task; });
    const uint32_t workers = jobs_.worker_count();
    const uint32_t together_count = workers > 1 ? shared_works({works, count}, workers) : 0;
    const auto run_of = [&](uint32_t t) {
        return BrittleLoop::Run{t, tasks.steps_done[t], tasks.steps_granted[t], task_goes_on};
    };
    const auto loop_of = [&](uint32_t t) -> const BrittleLoop& { return is_quick_task(state, t) ? quick_ : brittle_; };
    for (uint32_t i = 0; i < together_count; ++i) {
        const uint32_t task = works[i].task;
        BrittleLoop::Team team(loop_of(task), world, run_of(task), workers);
        parallel_for(jobs_, workers, [&](uint32_t worker) {
            const uint64_t start = now_ns();
            team.work(worker);
            profiler_.add_span(zone_, start, now_ns());
        });
    }
    parallel_for(jobs_, count - together_count, [&](uint32_t i) {
        const uint32_t task = works[together_count + i].task;
        const uint64_t start = now_ns();
        loop_of(task).run_alone(world, run_of(task));
        profiler_.add_span(zone_, start, now_ns());
    });
    uint64_t unspent = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t t = works[i].task;
        const uint64_t left = tasks.steps_granted[t] * units_of_step(state, t);
        unspent += left - std::min(left, units_of_end(state, t));
    }
    return unspent;
}

// What was granted for cuts that did not come is left.
void advance_damage(Serial, RunRows& rows, const Blows& blows, DamageLoop& loop, DamageCounts& counts) {
    const uint64_t unspent = std::min(loop.advance(rows, blows), counts.units_used);
    counts.units_used -= unspent;
    counts.units_left += unspent;
}

}  // namespace cullet
