// Which triangles of a closed surface are opposite each other across a wall, and which of the two sides each is on.
#pragma once
#include "systems/cook/surface.hpp"

namespace cullet {

enum class WallSide : uint8_t { None, One, Other };

struct WallSides {
    std::vector<uint32_t> opposite;  // triangle across the wall, kNone: none within reach that looks the other way
    std::vector<WallSide> side;      // of matched triangles, and of what hangs together with one side alone
    std::vector<uint8_t> is_lip;     // unmatched, and between the two sides
    std::vector<uint32_t> nearest;   // matched triangle nearest over neighbours, for those unmatched; kNone: none
};

/// `reach` in m. Looks at closed parts only.
WallSides find_wall_sides(const Surface& surface, double reach);

}  // namespace cullet
