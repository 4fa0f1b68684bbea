// A cell's elements in groups flat enough that a convex hull fits each.
#pragma once
#include <span>

#include "components/state.hpp"

namespace cullet {

/// Part p is elements first[p] .. first[p] + size[p] of a list that splitting reorders.
struct CellParts {
    uint32_t first[kMostCellParts], size[kMostCellParts], count = 0;

    std::span<const uint32_t> list(std::span<const uint32_t> elements, uint32_t part) const {
        return elements.subspan(first[part], size[part]);
    }
};

/// Halves, while there are parts left, the one that a hull over it would bury deepest: along the tangent in which its
/// extent times the turn of its normals / 8 (the sagitta of an arc) is most, until that is 1 mm or a tenth of the wall.
/// Cells hold at most 256 elements here. Without it, what lay in the hollow of a vase's shard hovered by up to
/// 16 mm over what is drawn.
void split_by_bend(const ShellView& shell, std::span<uint32_t> elements, CellParts& parts);
/// Halves one part across its longest way. Returns the new part's number, or `part` where it is too small.
uint32_t split_by_reach(const ShellView& shell, std::span<uint32_t> elements, CellParts& parts, uint32_t part);

}  // namespace cullet
