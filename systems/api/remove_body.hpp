// A body goes: World::remove and World::retire.
#pragma once
#include "systems/world_data.hpp"

namespace cullet {

/// Hits and blows that wait on it go; those that it gave to others stay.
void drop_hits(State& state, Row<Bodies> body);

/// With the hits on it, those that are being worked off too.
void remove_body(WorldData& d, Row<Bodies> body);

}  // namespace cullet
