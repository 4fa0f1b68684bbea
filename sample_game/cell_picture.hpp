// A picture of what cooking cut a mesh into.
#pragma once
#include "cullet/model.hpp"
#include "sample_game/picture.hpp"

namespace cullet {

/// One colour a sub-shell of sheet metal, or a cell of what has none, from a corner above. `threads` share the pixels.
Picture draw_cells(const Model& model, uint32_t threads, uint32_t width = 1280);

}  // namespace cullet
