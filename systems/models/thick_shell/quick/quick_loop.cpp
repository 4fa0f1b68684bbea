#include "systems/models/thick_shell/quick/quick_loop.hpp"

#include "systems/models/thick_shell/quick/costs.hpp"
#include "systems/models/thick_shell/quick/systems.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/springs/press_layers.hpp"

namespace cullet {
namespace {

constexpr uint32_t kStepsARegionCheck = 16;  // of the energy

}  // namespace

BrittleLoop make_quick_loop() {
    BrittleLoop loop;
    loop.then<push_region_patches>()
        .then<integrate_region>()
        .then<end_region_step>()
        .then<split_region>()
        .then<check_region_energy>(kStepsARegionCheck)
        .finish();
    return loop;
}

uint64_t quick_units_a_step(const RunRows& state, uint32_t task) {
    const QuickRuns& runs = state.quick_runs;
    const Row<ShellSprings> springs = runs.springs[task];
    if (!springs.exists()) return 1;
    const uint64_t edges = state.shell_springs.springs[springs].count;
    const bool has_layers = state.shell_springs.layers[springs].capacity > 0;
    return edges * (has_layers ? kUnitsQuickPair : kUnitsQuickSpring) +
           units_of_energies(state.shell_springs, springs) + 300;
}

uint64_t quick_units_of_end(const RunRows& state, uint32_t task) {
    return state.shells.vertices[state.shell_of(state.tasks.working[task])].count * kUnitsQuickEnd;
}

}  // namespace cullet
