// Depth limits of a vertex before any two elements are compared (thick shell notes A2 and A2b).
#pragma once
#include "systems/structures/shell/cook/opposite_wall.hpp"

namespace cullet {

/// Caps by opposite walls of the vertices marked (all when empty).
void find_wall_caps(ExtrusionWork& work, const OppositeWall& wall, const std::vector<uint8_t>& is_marked);

/// first_caps = wall_caps, limited to D(v) <= D(u) + |uv| over every edge; caps the same.
void find_first_caps(ExtrusionWork& work);

/// first_caps = wall_caps, limited to D(v) <= D(u) + |uv| over every edge; caps = first_caps, lowered until every
/// element is sound at full depth.
void find_local_caps(ExtrusionWork& work);

/// Evens out directions where local caps bite, patch by patch, wherever that makes the wall thicker; then all caps
/// again.
void straighten(ExtrusionWork& work, const OppositeWall& wall);

}  // namespace cullet
