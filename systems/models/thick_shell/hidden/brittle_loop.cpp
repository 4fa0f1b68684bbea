#include "systems/models/thick_shell/hidden/brittle_loop.hpp"

#include "systems/costs.hpp"
#include "systems/systems.hpp"

namespace cullet {

BrittleLoop make_brittle_loop() {
    BrittleLoop loop;
    loop.then<push_patches>()
        .then<integrate_hidden>()
        .then<pass_impulses>()
        .then<strain_check>(kStepsAStressCheck)
        .then<stress_check>(kStepsAStressCheck)
        .then<split_vertices>(kStepsAStressCheck)
        .then<check_energy>(kStepsAnEnergyCheck)
        .finish();
    return loop;
}

bool task_goes_on(LoopWorld& world, uint32_t task) {
    const Tasks& tasks = world.state.tasks;
    return static_cast<TaskState>(tasks.state[task]) == TaskState::Running && tasks.steps_granted[task] > 0;
}

}  // namespace cullet
