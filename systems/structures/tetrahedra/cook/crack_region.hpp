// What of a cooked solid a break has to cut again: triangles and faces where two pieces meet, and no others. All else
// belongs to one piece, which is known without a cut (solid cooking note, section 7, step 3).
#pragma once
#include <span>

#include "systems/structures/tetrahedra/cook/cook_solid.hpp"

namespace cullet {

inline constexpr uint32_t kManyPieces = 0xfffffffeu;

struct CrackRegion {
    /// Of each tetrahedron: the piece that all of it belongs to; kNone: others have it; kManyPieces: its parts differ.
    List<uint32_t> of_tetrahedron;
    List<uint32_t> of_triangle;  // in the same way; kManyPieces: it is cut
    List<uint32_t> triangles;    // that are cut, ascending
    List<uint32_t> faces;        // whose loops are wanted, ascending
    List<uint32_t> tetrahedra;   // of many pieces, ascending
    List<uint8_t> is_known;      // points of the lattice that stand where they were cooked
};

/// CookedSolid::owner_of_empty: that of the largest neighbour; farther out, of the neighbours nearer to the solid. The
/// choice knows no pieces, so that what breaks again is labelled as it was.
std::vector<uint32_t> owners_of_empty(const CookedSolid& solid);

/// `points`: of the lattice, moved; empty: as cooked. `piece_of`: of each cell; kNone: others have it. What is cut is
/// what a cut of all would find to belong to several pieces, and a little more.
CrackRegion find_crack_region(const CookedSolid& solid, std::span<const Vec3d> points,
                              std::span<const uint32_t> piece_of);

}  // namespace cullet
