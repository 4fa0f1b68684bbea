// Runs the inner loops of open damage tasks on all workers.
#pragma once
#include <string>

#include "systems/damage/brittle_loop.hpp"

namespace cullet {

struct DamageLoop {
    DamageLoop(State& state, JobSystem& jobs, Profiler& profiler);

    /// Every running task by its granted steps. With as many tasks as workers one job a task; with fewer, all workers
    /// share each task of more than kTeamVertices vertices, one after another, and the rest go one job a task.
    /// Returns the units that were granted and not used.
    uint64_t advance();
    std::string describe() const {
        return brittle_.describe() + "      thick shell, quick: 8 to 100 times a hit\n" + quick_.describe();
    }

    /// For the frame plan: its inner loop reads and writes all tables of a task.
    static constexpr auto tables() { return State::tables(); }

 private:
    LoopWorld world_;
    JobSystem& jobs_;
    Profiler& profiler_;
    BrittleLoop brittle_, quick_;
    uint32_t zone_;
};

}  // namespace cullet
