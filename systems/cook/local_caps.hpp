// Depth limits of a vertex before any two elements are compared (thick shell notes A2 and A2b).
#pragma once
#include "systems/cook/opposite_wall.hpp"

namespace cullet {

/// First caps of the vertices marked (all when empty), by opposite walls, then D(v) <= D(u) + |uv| over every edge.
void find_first_caps(ExtrusionWork& work, const OppositeWall& wall, const std::vector<uint8_t>& is_marked);

/// caps = first_caps, lowered until every element is sound at full depth.
void find_local_caps(ExtrusionWork& work);

/// Evens out directions where local caps bite, patch by patch, wherever that makes the wall thicker; then all caps again.
void straighten(ExtrusionWork& work, const OppositeWall& wall);

}  // namespace cullet
