#include "systems/models/thick_shell/hidden/brittle_loop.hpp"

#include "systems/models/thick_shell/hidden/costs.hpp"
#include "systems/models/thick_shell/hidden/systems.hpp"

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
    return task_goes_on(world.state.tasks, task);
}

}  // namespace cullet
