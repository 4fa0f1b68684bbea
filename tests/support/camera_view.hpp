// What the camera of a scene sees of what breaks there.
#pragma once
#include <algorithm>

#include "sample_game/game_world.hpp"

namespace cullet::test {

/// Area on its way into the eye, m2.
struct Seen {
    double all = 0, inside = 0, hidden = 0;
    double lowest = 1, highest = -1;  // of what is inside, from the picture's lower side -1 to its upper side 1
    /// Of the picture's height that what is inside takes.
    double height() const { return std::max(0.0, 0.5 * (highest - lowest)); }
};

/// As the world is now. Hidden is what stands behind something that does not break.
Seen seen_of(const GameWorld& game);

}  // namespace cullet::test
