#include "systems/models/thick_shell/springs/spring_loop.hpp"

#include "systems/models/thick_shell/springs/systems.hpp"

namespace cullet {

SpringLoop make_spring_loop(SpringLayout layout) {
    SpringLoop loop;
    if (layout == SpringLayout::OneLayer)
        loop.then<integrate_springs>();
    else
        loop.then<integrate_layers>();
    loop.then<end_spring_step>().finish();
    return loop;
}

void run_springs(ShellRows& state, Row<ShellSprings> row, uint32_t steps) {
    const auto layout = static_cast<SpringLayout>(state.shell_springs.layout[row]);
    SpringWorld world{state};
    make_spring_loop(layout).run_alone(world, {row, state.shell_springs.steps[row], steps, nullptr});
}

}  // namespace cullet
