// A step of a run is done.
#pragma once
#include "components/tasks.hpp"

namespace cullet {

/// Units, as costs.hpp counts them.
struct StepUnits {
    uint64_t a_step, at_the_end;  // with what is born then
};

/// One step more is done, and one less is granted. The run ends when it is past `end` (s). Before its last step it
/// waits for a frame whose units are enough for that step and for what is born then: cuts may have used them up.
/// `units()` is asked for no other step.
template <class Units>
void count_step(Tasks& tasks, const HiddenRuns& runs, Row<Tasks> task, float end, Units&& units) {
    tasks.steps_granted[task] -= tasks.steps_granted[task] > 0;
    const auto time_at = [&](uint32_t steps) { return static_cast<float>(steps) * runs.time_step[task]; };
    const uint32_t done = ++tasks.steps_done[task];
    if (time_at(done) > end) {
        tasks.state[task] = static_cast<uint8_t>(TaskState::Whole);  // find_parts tells whether it broke
    } else if (time_at(done + 1) > end) {
        const StepUnits of = units();
        if (tasks.steps_granted[task] * of.a_step < of.a_step + of.at_the_end) tasks.steps_granted[task] = 0;
    }
}

}  // namespace cullet
