// A body goes: World::remove and World::retire.
#pragma once
#include "systems/world_data.hpp"

namespace cullet {

/// With the hits on it, those that are being worked off too.
void remove_body(WorldData& d, Row<Bodies> body);

}  // namespace cullet
