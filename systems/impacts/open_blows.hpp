// Tasks for the blows of the game, as the contacts of this step have them.
#pragma once
#include "systems/impacts/opening.hpp"

namespace cullet {

struct BlowOpening {
    Opening& opening;
    RigidWorld& rigid;
    const DamageSettings& settings;
    Events<ImpactEvent>& impact_events;
};

/// Whether a task may be opened at all (limits.open_hits).
bool has_free_task(const Tasks& tasks);

/// In the order of their rows: a blow joins the task that its body got in this step, or gets one, or waits while a task
/// runs, the body is held or it was hit less than 20 ms ago, and a cut while the frame's units are spent. What waits
/// has moved the body as a rigid one at once, and its task is late. Pushes and explosions too weak to matter, or
/// forbidden by the game, only move the body.
void open_blows(BlowOpening& opening);

}  // namespace cullet
