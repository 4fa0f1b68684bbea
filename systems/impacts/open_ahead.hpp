// Tasks for touches that are foreseen.
#pragma once
#include "systems/impacts/opening.hpp"

namespace cullet {

/// By which a touch may be slower or faster than foreseen.
inline constexpr float kForeseenShare = 0.1f;

/// Slower than what cracks its body for the first time, and by far slower than `foreseen`, which is still to come: it
/// waits for its turn.
bool is_bump(const BodyRows& state, const Impact& impact, float foreseen);

/// Behind the tasks of this step's contacts and blows, and at most on half of limits.open_hits: what is not here yet
/// takes nothing away from what is. A touch that comes before the one that a body's task is for takes its place.
void open_ahead(Opening& opening, const Events<ForeseenHit>& foreseen, const DamageSettings& settings);

}  // namespace cullet
