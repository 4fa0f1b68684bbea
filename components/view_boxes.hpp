// Bounds of drawn triangles, for queries.
#pragma once
#include "components/bodies.hpp"

namespace cullet {

/// Drawn triangles that share a box. Doubled, a ray tests twice the triangles and half the boxes.
inline constexpr uint32_t kTrianglesPerBox = 32;
inline constexpr uint32_t kViewGranule = 16;  // ranges of view_indices begin at multiples of it

/// Row view_indices.first / kViewGranule + n bounds the n-th kTrianglesPerBox drawn triangles of a body, body frame. It
/// is no part of a world's state: a drawn mesh gives it. Rows are written in place up to the limit, never appended.
struct ViewBoxes : Table<ViewBoxes> {
    using Table::Table;
    CULLET_TABLE(view_boxes);
    Column<std::array<float, 6>> box{*this, "box", "m", Keep::Scratch};     // low, then high
    Column<uint8_t> is_outdated{*this, "is_outdated", "1", Keep::Scratch};  // a triangle of it was redrawn
};

}  // namespace cullet
