// Pieces of a solid become structures: their rows.
#pragma once
#include <span>

#include "systems/structures/tetrahedra/solid_rooms.hpp"

namespace cullet {

/// For so many pieces as one structure.
SolidRoom room_for_pieces(const BrokenSolid& broken, std::span<const BrokenPiece> pieces);
/// What a row of Structures says, but for what the copy has of its own: ranges, users, its row.
void copy_structure(Structures& s, Row<Structures> from, Row<Structures> to);
/// All pieces that are one with `piece`, into a structure that has room for them: cells, moved points, skin, hulls; and
/// measures it.
void fill_solid(SolidRows rows, const BrokenSolid& broken, uint32_t piece, Row<Structures> structure);
/// Rows of a structure that nothing was written into.
void give_back_spare(SolidRows rows, Row<Structures> structure);

}  // namespace cullet
