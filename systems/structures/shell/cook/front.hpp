// Pushes all vertices inward together and sets back what met, as published (thick shell note A4).
#pragma once
#include "systems/structures/shell/cook/moving_faces.hpp"

namespace cullet {

/// Depths reached; local units. Two gaps that the paper has: setting some vertices back makes faces of old and new
/// corners that were never tested, and fronts that pass through each other within one step are not seen. Elements are
/// not tested. Counts the crossings that are left.
std::vector<double> run_front(ExtrusionWork& work);

}  // namespace cullet
