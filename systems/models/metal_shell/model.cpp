#include "systems/models/metal_shell/model.hpp"

#include "systems/models/metal_shell/calls.hpp"
#include "systems/models/metal_shell/check_metal.hpp"
#include "systems/models/metal_shell/cook_metal_shell.hpp"
#include "systems/models/metal_shell/loop.hpp"
#include "systems/models/metal_shell/systems.hpp"

namespace cullet {

DamageModel metal_shell_model() {
    using namespace metal_shell;
    DamageModel model("metal_shell");
    model.at(Slot::Wake).then<gather_impulses>();
    model.at(Slot::Group).then<group_dented>();
    model.loop<cost_of>("metal shell: one impact", make_loop(), {works_on});
    model.cooks<cook_metal_shell>().spawns<spawn_body>().spawns_own<spawn_shell>().says_why_not_cut<why_not_cut>();
    model.takes<take_shell, begin_run>().needs_room<room_of_hit, may_find_room>();
    model.checks<check_metal_shell>();
    return model;
}

}  // namespace cullet
