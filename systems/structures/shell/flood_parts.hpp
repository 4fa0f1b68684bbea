// Pieces found from their cracks inwards: what a hit costs then goes with the pieces that it frees and not with the
// body.
#pragma once
#include <span>

#include "components/shell_rows.hpp"
#include "systems/structures/shell/group_fragments.hpp"

namespace cullet {

inline constexpr uint32_t kMostFloods = 2048;

/// What came free of a shell that hung together before its edges were cut.
struct FloodedParts {
    /// Pieces, without the one that goes on as the rest of the shell; kNone where more elements lie at cracks than
    /// there may be floods, and nothing was found out.
    uint32_t pieces = 0;
    uint32_t visited = 0;                  // elements looked at
    uint16_t piece_of_flood[kMostFloods];  // or kRest
    static constexpr uint16_t kRest = 0xffff;

    /// Piece of an element, or kRest.
    uint16_t piece_of(const ShellView& shell, uint32_t element) const;

 private:
    friend void flood_parts(ShellView shell, FloodedParts& found, uint32_t most);
    friend uint32_t find_pieces(ShellView shell, std::span<FragmentPart> parts, uint32_t most);
    uint32_t root(uint32_t flood) const {
        while (parent[flood] != flood) flood = parent[flood];
        return flood;
    }
    uint16_t parent[kMostFloods];
};

/// Floods from both sides of every crack edge at once, an element each in turn; floods that meet become one, and one
/// that finds no more elements is a piece. It ends when one is left, which is the rest. Live elements of the shell must
/// have hung together when all of its crack edges were whole. Pieces are numbered by their smallest element. Uses the
/// scratch columns copy, next_in_cell, next and other_slope of its elements. At most `most` floods. O(elements of the
/// pieces times the pieces that are as large + crack edges), and a look at a byte an edge.
void flood_parts(ShellView shell, FloodedParts& found, uint32_t most = kMostFloods);

/// So many floods are less work than to number all elements of the shell anew.
uint32_t worthwhile_floods(const ShellView& shell);

/// For such a shell whose live elements are all numbered 0 (is_numbered_zero): the pieces get the numbers from 1 on, by
/// smallest element, with their lists. What is left keeps its number and its elements are not looked at: parts[0]
/// describes it without a list (is_listed), its mass is the shell's less the pieces'. Returns how many parts there are;
/// kNone, and numbers that are good for nothing, where there are too many floods or parts, or a piece is as heavy as
/// what is left. O(elements of the pieces), and a look at a byte an edge and a vertex.
uint32_t find_pieces(ShellView shell, std::span<FragmentPart> parts, uint32_t most = kMostFloods);

/// What group_fragments does, for such a shell: the flood finds the pieces, and one pass writes the numbers and chains
/// the elements. Where there are too many floods group_fragments does it all.
uint32_t group_from_cracks(ShellView shell, std::span<FragmentPart> parts, uint32_t most = kMostFloods);

}  // namespace cullet
