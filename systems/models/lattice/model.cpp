#include "systems/models/lattice/model.hpp"

#include "systems/models/lattice/calls.hpp"
#include "systems/models/lattice/cook_lattice.hpp"
#include "systems/models/lattice/loop.hpp"
#include "systems/models/lattice/shared/settings.hpp"
#include "systems/models/lattice/systems.hpp"

namespace cullet {

DamageModel lattice_model() {
    using namespace lattice;
    DamageModel model("lattice");
    model.at(Slot::Wake).then<start_breaks>();
    model.at(Slot::Group).then<count_pieces>();
    model.loop<cost_of>("lattice: one break", make_loop(), {call<works_on>});
    model.cook_settings<&CookSettings::lattice>("lattice");
    model.cooks<cook_lattice>().spawns<spawn_body>().says_why_not_cut<why_not_cut>();
    model.takes<take_copy, begin_task>().needs_room<room_of_hit, may_find_room>();
    model.takes_turns<is_full>().breaks_at_any_speed();
    model.restores<restore_run, restore_body>();
    model.checks_own<trouble_of_run, check_rows>();
    return model;
}

}  // namespace cullet
