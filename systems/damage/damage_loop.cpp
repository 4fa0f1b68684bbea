#include "systems/damage/damage_loop.hpp"

#include "systems/costs.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

bool goes_on(WorldData& world, uint32_t task) {
    return static_cast<TaskState>(world.state.tasks.state[task]) == TaskState::Running && world.state.tasks.steps_granted[task] > 0;
}

}  // namespace

DamageLoop::DamageLoop(WorldData& world, JobSystem& jobs, Profiler& profiler)
    : world_(world), jobs_(jobs), profiler_(profiler) {
    brittle_.then<push_patches>()
        .then<integrate_hidden>()
        .then<pass_impulses>()
        .then<bend_hinges>(kStepsAStressCheck)
        .then<stress_check>(kStepsAStressCheck)
        .then<split_vertices>(kStepsAStressCheck)
        .then<check_energy>(kStepsAnEnergyCheck)
        .finish();
    zone_ = profiler.add_zone("damage task");
}

void DamageLoop::advance() {
    static constexpr uint32_t kMostTasks = 1024;
    const Tasks& tasks = world_.state.tasks;
    uint32_t alone[kMostTasks], together[kMostTasks], alone_count = 0, together_count = 0;
    for (uint32_t t = 0; t < tasks.size(); ++t) {
        if (static_cast<TaskState>(tasks.state[t]) != TaskState::Running || tasks.steps_granted[t] == 0) continue;
        if (world_.state.shells.vertices[tasks.shell[t]].count > kTeamVertices && together_count < kMostTasks)
            together[together_count++] = t;
        else if (alone_count < kMostTasks)
            alone[alone_count++] = t;
    }
    const uint32_t workers = jobs_.worker_count();
    if (together_count >= workers || workers == 1) {
        for (uint32_t i = 0; i < together_count && alone_count < kMostTasks; ++i) alone[alone_count++] = together[i];
        together_count = 0;
    }
    for (uint32_t i = 0; i < together_count; ++i) {
        const uint32_t t = together[i];
        InnerLoop<WorldData>::Team team(brittle_, world_,
                                        {t, tasks.steps_done[t], tasks.steps_granted[t], goes_on});
        parallel_for(jobs_, workers, [&](uint32_t worker) {
            const uint64_t start = now_ns();
            team.work();
            profiler_.add_span(zone_, worker, start, now_ns());
        });
    }
    if (alone_count == 0) return;
    parallel_for(jobs_, alone_count, [&](uint32_t i) {
        const uint64_t start = now_ns();
        brittle_.run_alone(world_, {alone[i], tasks.steps_done[alone[i]], tasks.steps_granted[alone[i]], goes_on});
        profiler_.add_span(zone_, i % workers, start, now_ns());
    });
}

void advance_damage(Serial, DamageLoop& loop) { loop.advance(); }

}  // namespace cullet
