#include "systems/models/thick_shell/soft/soft_loop.hpp"

#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/soft/systems.hpp"
#include "systems/models/thick_shell/springs/systems.hpp"

namespace cullet {

Row<ShellSprings> SoftWorld::springs_of(uint32_t soft) const {
    return cullet::springs_of(state, Row<SoftBodies>(soft));
}

SoftInnerLoop make_soft_loop(SpringLayout layout) {
    SoftInnerLoop loop;
    if (layout == SpringLayout::OneLayer)
        loop.then<integrate_springs>();
    else
        loop.then<integrate_layers>();
    loop.then<meet_strikers>()
        .then<end_spring_step>()
        .then<flow_springs>(kSubstepsAFlow)
        .then<tear_springs>(kSubstepsAFlow);
    if (layout == SpringLayout::OneLayer) loop.then<bend_sheets>(kSubstepsAFlow);
    loop.finish();
    return loop;
}

}  // namespace cullet
