#include "tests/models/halves/model.hpp"

#include "tests/models/halves/calls.hpp"
#include "tests/models/halves/cook.hpp"
#include "tests/models/halves/loop.hpp"
#include "tests/models/halves/systems.hpp"

namespace cullet::halves {

DamageModel halves_model() {
    DamageModel model("halves");
    model.at(Slot::Wake).then<copy_wholes>().then<push_wholes>();
    model.at(Slot::Group).then<find_halves>();
    model.loop<cost_of>("halves: 8 times a hit", make_loop(), {call<works_on>});
    model.cooks<cook_halves>().spawns<spawn_body>();
    model.takes<take_shell, begin_run>().needs_room<room_of_hit, may_find_room>();
    model.checks<check_halves>();
    return model;
}

}  // namespace cullet::halves
