// The closed surfaces of the pieces of a solid: what they have of its triangles, and crack faces that meet them in the
// same points (solid cooking note, section 7, step 4).
#pragma once
#include <span>

#include "cullet/result.hpp"
#include "systems/structures/tetrahedra/cook/cook_solid.hpp"

namespace cullet {

struct PieceTriangle {
    std::array<uint32_t, 3> corners;  // of places, counter-clockwise from outside
    uint32_t source = 0;              // triangle of the closed mesh; kNone: of a crack
};
struct PieceSkin {
    List<Vec3d> places;  // m, each once
    List<PieceTriangle> triangles;
};

/// `piece_of`: of each cell, below `count`; kNone: it left with others before. `points`: of the lattice, those that
/// cracks moved included; empty: as cooked. Triangles whose polygons all have one piece go to it whole. Every directed
/// edge of a skin runs back as often.
Result<List<PieceSkin>> cut_pieces(const CookedSolid& solid, std::span<const Vec3d> points,
                                   std::span<const uint32_t> piece_of, uint32_t count);

}  // namespace cullet
