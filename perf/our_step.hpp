// Our hidden step as the frame runs it, for tasks without contacts.
#pragma once
#include "engine/jobs.hpp"
#include "systems/models/thick_shell/hidden/brittle_loop.hpp"

namespace cullet::perf {

/// The system, called by the inner loop on one thread or by a team, and where the task has a region what moves the
/// region's rest. Of task row 0.
class OurStep {
 public:
    explicit OurStep(RunRows& state, bool with_rest = false);
    void run(uint32_t steps, JobSystem* team);

 private:
    const Blows none_{1};
    LoopWorld world_;
    BrittleLoop loop_;
};

}  // namespace cullet::perf
