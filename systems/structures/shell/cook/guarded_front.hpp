// Pushes all vertices inward together, in rounds, and sets back what would meet (thick shell note A5).
#pragma once
#include "systems/structures/shell/cook/moving_faces.hpp"

namespace cullet {

/// Depths reached, each between 0 and its cap; local units. Every state between two rounds is valid: elements are
/// sound, and no two listed faces touch.
std::vector<double> run_guarded_front(ExtrusionWork& work);

}  // namespace cullet
