#include "systems/damage/damage_loop.hpp"

#include <algorithm>

#include "systems/damage/task_cost.hpp"
#include "systems/quick/quick_body.hpp"
#include "systems/quick/quick_loop.hpp"
#include "systems/systems.hpp"

namespace cullet {

DamageLoop::DamageLoop(State& state, JobSystem& jobs, Profiler& profiler)
    : world_{state},
      jobs_(jobs),
      profiler_(profiler),
      brittle_(make_brittle_loop()),
      quick_(make_quick_loop()),
      zone_(profiler.add_zone("damage task")) {}

uint64_t DamageLoop::advance() {
    static constexpr uint32_t kMostTasks = 1024;
    const Tasks& tasks = world_.state.tasks;
    uint32_t alone[kMostTasks], together[kMostTasks], alone_count = 0, together_count = 0;
    for (uint32_t t = 0; t < tasks.size() && alone_count + together_count < kMostTasks; ++t) {
        if (static_cast<TaskState>(tasks.state[t]) != TaskState::Running || tasks.steps_granted[t] == 0) continue;
        const uint32_t moving = is_quick_task(world_.state, t) ? kLanes * world_.state.quick_runs.pack_count[t]
                                                               : world_.state.shells.vertices[tasks.shell[t]].count;
        if (moving > kTeamVertices)
            together[together_count++] = t;
        else
            alone[alone_count++] = t;
    }
    const uint32_t workers = jobs_.worker_count();
    if (together_count >= workers || workers == 1) {
        for (uint32_t i = 0; i < together_count; ++i) alone[alone_count++] = together[i];
        together_count = 0;
    }
    const auto run_of = [&](uint32_t t) {
        return BrittleLoop::Run{t, tasks.steps_done[t], tasks.steps_granted[t], task_goes_on};
    };
    const auto loop_of = [&](uint32_t t) -> const BrittleLoop& {
        return is_quick_task(world_.state, t) ? quick_ : brittle_;
    };
    for (uint32_t i = 0; i < together_count; ++i) {
        BrittleLoop::Team team(loop_of(together[i]), world_, run_of(together[i]), workers);
        parallel_for(jobs_, workers, [&](uint32_t worker) {
            const uint64_t start = now_ns();
            team.work(worker);
            profiler_.add_span(zone_, start, now_ns());
        });
    }
    parallel_for(jobs_, alone_count, [&](uint32_t i) {
        const uint64_t start = now_ns();
        loop_of(alone[i]).run_alone(world_, run_of(alone[i]));
        profiler_.add_span(zone_, start, now_ns());
    });
    uint64_t unspent = 0;
    const auto count_unspent = [&](uint32_t t) {
        unspent +=
            tasks.steps_granted[t] * (is_quick_task(world_.state, t) ? quick_units_a_step(world_.state, t)
                                                                     : units_a_step(world_.state.shells, tasks, t));
    };
    std::for_each(together, together + together_count, count_unspent);
    std::for_each(alone, alone + alone_count, count_unspent);
    return unspent;
}

// What was granted for cuts that did not come is left.
void advance_damage(Serial, DamageLoop& loop, DamageCounts& counts) {
    const uint64_t unspent = std::min(loop.advance(), counts.units_used);
    counts.units_used -= unspent;
    counts.units_left += unspent;
}

}  // namespace cullet
