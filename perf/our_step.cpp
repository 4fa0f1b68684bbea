#include "perf/our_step.hpp"

#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/hidden/systems.hpp"

namespace cullet::perf {
namespace {

/// What pass_impulses does for a region, without its contacts.
void follow_rest(Of<Tasks> task, Turn turn, RunRows& rows) {
    move_rest(rows, task.row, turn.old_side);
}

}  // namespace

OurStep::OurStep(RunRows& state, bool with_rest) : world_{state, none_} {
    loop_.then<integrate_hidden>();
    if (with_rest) loop_.then<follow_rest>();
    loop_.finish();
}

void OurStep::run(uint32_t steps, JobSystem* team) {
    const BrittleLoop::Run run{0, 0, steps, nullptr};
    if (!team) return loop_.run_alone(world_, run);
    BrittleLoop::Team shared(loop_, world_, run, team->worker_count());
    parallel_for(*team, team->worker_count(), [&](uint32_t worker) { shared.work(worker); });
}

}  // namespace cullet::perf
