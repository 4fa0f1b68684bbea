// Tasks for touches that are foreseen.
#pragma once
#include "systems/damage/opening.hpp"

namespace cullet {

/// Behind the tasks of this step's contacts and blows, and at most on half of limits.open_hits: what is not here yet
/// takes nothing away from what is.
void open_ahead(Opening& opening, const Events<ForeseenHit>& foreseen, const DamageSettings& settings);

}  // namespace cullet
