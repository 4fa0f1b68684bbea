// What waits for a body that falls into pieces goes on to them.
#pragma once
#include "systems/births/planning.hpp"

namespace cullet {

/// Hits go to the piece that owns the nearest vertex; debris takes its own along.
void hand_on_hits(Planning& planning, const Break& plan);

/// Blows: a push goes as a hit does, explosions and cuts go to all pieces. They have moved the body already. Each piece
/// keeps its share, by mass, of the impulse.
void hand_on_blows(Planning& planning, const Break& plan);

}  // namespace cullet
