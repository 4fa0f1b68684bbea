// Pieces of all sizes and shells of all thicknesses that are thrown onto sheets and into corners, each for itself.
#pragma once
#include <cstdint>

namespace cullet {

struct ThrownPieces {
    uint32_t pieces = 0, behind = 0;  // behind: at the end, or ever, on the other side of a sheet
    float farthest = 0;               // m behind, of the worst one
};

/// What happens to `count` pieces in the second after they are thrown, at so many steps a second. `seed` chooses
/// pieces, places, speeds up to 30 m/s, and sheets.
ThrownPieces throw_pieces(uint64_t seed, uint32_t count, uint32_t steps_a_second);

}  // namespace cullet
