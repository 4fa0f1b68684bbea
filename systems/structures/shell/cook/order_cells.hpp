// The order of a shell's vertices: cells of at most 64 that are compact on the surface, one after another.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/math.hpp"

namespace cullet {

struct CellOrder {
    std::vector<uint32_t> row;        // of each vertex
    std::vector<uint32_t> first_row;  // of each cell, a multiple of 8
    uint32_t row_count = 0;           // a multiple of 8; rows that no vertex has are padding
};

/// Each connected part is halved again and again across its longest way (along edges, by length) at a multiple of 8
/// vertices until 64 or fewer are left, so that padding is under 8 rows a connected part. In a cell vertices stand
/// breadth-first from one end. Growing patches one by one instead leaves many small ones between them.
/// O(n log n log(n/64)).
CellOrder order_cells(std::span<const Vec3d> position, std::span<const std::array<uint32_t, 3>> corner);

}  // namespace cullet
