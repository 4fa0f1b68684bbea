// A solid before anything of it cracked.
#pragma once
#include "systems/models/lattice/crack/break_run.hpp"

namespace cullet {

/// Its pieces, which are its parts, and their volumes. `own`: as for begin_break.
void begin_pieces(const BreakableSolid& body, std::span<const uint8_t> own, BreakRun& run);

}  // namespace cullet
