// The inner loops of all models, and who runs them.
#pragma once
#include "engine/runs.hpp"
#include "systems/models/thick_shell/hidden/brittle_loop.hpp"
#include "systems/models/thick_shell/soft/soft_loop.hpp"

namespace cullet {

class SlottedPlan;

struct RunLoops {
    /// `most_runs`: of one frame.
    RunLoops(JobSystem& jobs, Profiler& profiler, uint32_t most_runs);

    JobSystem& jobs;
    Profiler& profiler;
    BrittleLoop hidden, quick;
    SoftInnerLoop soft_one_layer, soft_layers;
    uint32_t task_zone, soft_zone;
    Runs runs;

    /// Each loop, with the system named last.
    void show_in(SlottedPlan& plan) const;
};

}  // namespace cullet
