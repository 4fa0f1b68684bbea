#include "systems/models/metal_shell/model.hpp"

#include "systems/drawn/query_index.hpp"
#include "systems/models/metal_shell/calls.hpp"
#include "systems/models/metal_shell/check_metal.hpp"
#include "systems/models/metal_shell/cook_metal_shell.hpp"
#include "systems/models/metal_shell/dent/feel.hpp"
#include "systems/models/metal_shell/loop.hpp"
#include "systems/models/metal_shell/shared/settings.hpp"
#include "systems/models/metal_shell/systems.hpp"

namespace cullet {

DamageModel metal_shell_model() {
    using namespace metal_shell;
    DamageModel model("metal_shell");
    model.at(Slot::Wake).then<gather_impulses>();
    model.at(Slot::Close).then<end_impacts>();
    model.at(Slot::Group).then<group_dented>();
    TaskCalls calls{call<works_on>};
    calls.is_brief = true;
    model.loop<cost_of>("metal shell: one impact", make_loop(), calls);
    model.cook_settings<&CookSettings::metal_shell>();
    model.cooks<cook_metal_shell>()
        .splits_edges<edge_share>()
        .spawns<spawn_body>()
        .spawns_own<spawn_shell>()
        .says_why_not_cut<why_not_cut>();
    model.yields_to_presses<note_press, flat_width>();
    model.takes<take_shell, begin_run>().needs_room<room_of_hit, may_find_room>();
    model.checks<check_metal_shell>().checks_own<trouble_of_run, check_metal_rows>();
    model.passes_over<leaves_nothing>().inherits<inherit_nothing>();
    return model;
}

}  // namespace cullet
