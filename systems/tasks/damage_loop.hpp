// Runs the inner loops of open damage tasks on all workers.
#pragma once
#include <string>

#include "systems/models/thick_shell/hidden/brittle_loop.hpp"

namespace cullet {

struct DamageLoop {
    DamageLoop(JobSystem& jobs, Profiler& profiler);

    /// Every running task by its granted steps, longest first: one job a task, but for those of more than kTeamVertices
    /// vertices that would keep one worker longer than the others, which all workers share, one after another.
    /// Returns the units that were granted and not used.
    uint64_t advance(RunRows& rows, const Blows& blows);
    std::string describe() const {
        return brittle_.describe() + "      thick shell, quick: 8 to 100 times a hit\n" + quick_.describe();
    }

 private:
    JobSystem& jobs_;
    Profiler& profiler_;
    BrittleLoop brittle_, quick_;
    uint32_t zone_;
};

}  // namespace cullet
