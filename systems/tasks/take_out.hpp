// A body goes, with the hits on it: what the game removes, and what is ground to debris.
#pragma once
#include "systems/world_data.hpp"

namespace cullet {

/// Hits and blows that wait on it go; those that it gave to others stay.
void drop_hits(WaitingHits waiting, Row<Bodies> body);

/// With the hits on it, those that are being worked off too. Queries know it until they are refreshed.
void take_out(WorldRows& rows, WaitingHits waiting, RigidWorld& rigid, const DamageModels& models, Row<Bodies> body);

}  // namespace cullet
