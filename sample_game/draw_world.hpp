// A picture of a world as it stands.
#pragma once
#include "sample_game/game_world.hpp"
#include "sample_game/unmoved.hpp"

namespace cullet {

/// As things look, or every body in the colour of its number; balls in steel, props in their own colours, debris as
/// small lumps. `threads` share the pixels; the picture is the same on any number. 16 to 9.
Picture draw_world(const GameWorld& game, const Camera& camera, PictureLook look, uint32_t threads,
                   uint32_t width = 960, const Unmoved& unmoved = {});

}  // namespace cullet
