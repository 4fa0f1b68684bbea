#include <algorithm>

#include "systems/models.hpp"
#include "systems/models/thick_shell/quick/quick_loop.hpp"
#include "systems/models/thick_shell/soft/soft_units.hpp"
#include "systems/models/thick_shell/task_cost.hpp"
#include "systems/systems.hpp"
#include "systems/tasks/run_loops.hpp"

namespace cullet {
namespace {

/// What was granted for cuts that did not come. What a run that has ended brings with it in this frame is paid before.
uint64_t left_over(LoopWorld& world, uint32_t t) {
    const Tasks& tasks = world.state.tasks;
    const TaskCost cost = task_cost(world.state, t);
    const bool has_ended = static_cast<TaskState>(tasks.state[t]) != TaskState::Running;
    const uint64_t left = tasks.steps_granted[t] * cost.step;
    return left - std::min(left, has_ended ? cost.end : 0);
}

void list_tasks(LoopWorld& world, RunLoops& loops) {
    const Tasks& tasks = world.state.tasks;
    for (uint32_t t = 0; t < tasks.size(); ++t) {
        if (static_cast<TaskState>(tasks.state[t]) != TaskState::Running || tasks.steps_granted[t] == 0) continue;
        // More is granted than there are steps left: for cuts.
        const uint32_t steps = std::min(tasks.steps_granted[t], std::max(1u, steps_left(tasks, t, 0)));
        loops.runs.add(LoopRun(is_quick_task(world.state, t) ? loops.quick : loops.hidden, world,
                               {t, tasks.steps_done[t], tasks.steps_granted[t], task_goes_on},
                               steps * task_cost(world.state, t).step, moving_vertices(world.state, t) > kTeamVertices,
                               loops.task_zone, left_over));
    }
}

void list_soft_bodies(SoftWorld& world, RunLoops& loops) {
    const SoftBodies& soft = world.state.soft_bodies;
    const ShellSprings& springs = world.state.shell_springs;
    for (uint32_t s = 0; s < soft.size(); ++s) {
        if (!soft.is_used[s] || !soft.is_awake[s]) continue;
        const Row<ShellSprings> row = world.springs_of(s);
        const bool has_layers = static_cast<SpringLayout>(springs.layout[row]) != SpringLayout::OneLayer;
        loops.runs.add(LoopRun(
            has_layers ? loops.soft_layers : loops.soft_one_layer, world,
            {s, springs.steps[row], soft.granted[s], nullptr}, soft.granted[s] * soft_units_a_substep(springs, row),
            world.state.shells.vertices[springs.shell[row]].count > kSoftTeamVertices, loops.soft_zone));
    }
}

}  // namespace

RunLoops::RunLoops(JobSystem& j, Profiler& p, uint32_t most_runs)
    : jobs(j),
      profiler(p),
      hidden(make_brittle_loop()),
      quick(make_quick_loop()),
      soft_one_layer(make_soft_loop(SpringLayout::OneLayer)),
      soft_layers(make_soft_loop(SpringLayout::Sandwich)),
      task_zone(p.add_zone("damage task")),
      soft_zone(p.add_zone("soft body")),
      runs(most_runs) {}

void RunLoops::show_in(SlottedPlan& plan) const {
    plan.shows("thick shell, brittle: 300 to 4,000 times a hit, on its own clock", hidden)
        .shows("thick shell, quick: 8 to 100 times a hit", quick)
        .shows("thick shell, ductile and elastic: 8 to 1,000 times a frame", soft_one_layer)
        .shows("the same, of bodies with an inner and an outer layer", soft_layers);
}

void advance_runs(Serial, SoftRows& rows, const Blows& blows, RunLoops& loops, DamageCounts& counts) {
    LoopWorld tasks{rows, blows};
    SoftWorld soft{rows};
    loops.runs.clear();
    list_tasks(tasks, loops);
    list_soft_bodies(soft, loops);
    const uint64_t unspent = std::min(loops.runs.advance(loops.jobs, loops.profiler), counts.units_used);
    counts.units_used -= unspent;
    counts.units_left += unspent;
}

}  // namespace cullet
