// Who runs the inner loops of all models.
#pragma once
#include "engine/runs.hpp"

namespace cullet {

class DamageModels;

struct RunLoops {
    /// `most_runs`: of one frame.
    RunLoops(JobSystem& jobs, Profiler& profiler, const DamageModels& models, uint32_t most_runs);

    JobSystem& jobs;
    Profiler& profiler;
    uint32_t task_zone;
    std::vector<uint32_t> frame_zones;  // one a model
    Runs runs;
};

}  // namespace cullet
