#include "systems/springs/spring_loop.hpp"

#include "systems/systems.hpp"

namespace cullet {

SpringLoop make_spring_loop(SpringLayout layout, bool has_energies) {
    SpringLoop loop;
    if (has_energies) loop.then<press_layers>();
    if (layout == SpringLayout::OneLayer)
        loop.then<integrate_springs>();
    else
        loop.then<integrate_layers>();
    loop.then<end_spring_step>().finish();
    return loop;
}

bool has_energies(const ShellSprings& springs, Row<ShellSprings> row) {
    return springs.area_energy[row] > 0 || springs.volume_energy[row] > 0;
}

void run_springs(State& state, Row<ShellSprings> row, uint32_t steps) {
    const auto layout = static_cast<SpringLayout>(state.shell_springs.layout[row]);
    SpringWorld world{state};
    make_spring_loop(layout, has_energies(state.shell_springs, row))
        .run_alone(world, {row, state.shell_springs.steps[row], steps, nullptr});
}

}  // namespace cullet
