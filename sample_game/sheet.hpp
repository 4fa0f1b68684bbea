// The contact sheet: a run's pictures in one, so that somebody looks at all of them.
#pragma once
#include <span>

#include "sample_game/png.hpp"

namespace cullet {

struct SheetTile {
    const Picture* picture = nullptr;  // null or empty leaves the tile dark
    uint32_t frame = 0;                // the number written into the corner
};

struct SheetSettings {
    uint32_t columns = 4;
    uint32_t tile_width = 480, tile_height = 270;  // a picture of another shape is fitted in, never stretched
    uint32_t margin = 4;                           // pixels between tiles
};

/// Tiles from left to right, then down; 12 tiles make 4 x 3. Pictures are scaled down by the mean of what each new
/// pixel covers, in linear light, so that thin lines fade and do not vanish.
Picture contact_sheet(std::span<const SheetTile> tiles, const SheetSettings& settings);

}  // namespace cullet
