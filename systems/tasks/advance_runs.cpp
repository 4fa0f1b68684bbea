#include <algorithm>

#include "systems/models.hpp"
#include "systems/systems.hpp"
#include "systems/tasks/run_loops.hpp"

namespace cullet {
namespace {

void list_tasks(WorldRows& rows, const Blows& blows, const DamageModels& models, RunLoops& loops) {
    const Tasks& tasks = rows.tasks;
    for (uint32_t t = 0; t < tasks.size(); ++t)
        if (task_goes_on(tasks, t)) loops.runs.add(models.loop_of(rows, t).run(rows, blows, t, loops.task_zone));
}

void list_frame_loops(WorldRows& rows, const DamageModels& models, RunLoops& loops) {
    size_t next = 0;
    for (const DamageModel& model : models) {
        const uint32_t zone = loops.frame_zones[next++];
        for (const FrameLoop& loop : model.frame_loops()) loop.list_runs(rows, zone, loops.runs);
    }
}

}  // namespace

RunLoops::RunLoops(JobSystem& j, Profiler& p, const DamageModels& models, uint32_t most_runs)
    : jobs(j), profiler(p), task_zone(p.add_zone("damage task")), runs(most_runs) {
    for (const DamageModel& model : models)
        frame_zones.push_back(model.frame_loops().empty() ? task_zone : p.add_zone(model.frame_zone()));
}

void advance_runs(Serial, WorldRows& rows, const Blows& blows, const DamageModels& models, RunLoops& loops,
                  DamageCounts& counts) {
    loops.runs.clear();
    list_tasks(rows, blows, models, loops);
    list_frame_loops(rows, models, loops);
    const uint64_t unspent = std::min(loops.runs.advance(loops.jobs, loops.profiler), counts.units_used);
    counts.units_used -= unspent;
    counts.units_left += unspent;
}

}  // namespace cullet
