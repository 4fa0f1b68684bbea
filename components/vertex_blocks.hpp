// What a large body's vertices weigh and where they are, kept so that a hit need not look at all of them.
#pragma once
#include "components/shells.hpp"

namespace cullet {

/// Vertices that share a row. Ranges of vertices begin at multiples of it. Doubled, a search looks at twice the
/// vertices and half the boxes.
inline constexpr uint32_t kVerticesPerBlock = 64;

enum class BlockSums : uint8_t { NotKept = 0, Outdated, Known };

/// Row b is of the live vertices in rows [64 b, 64 b + 64), body frame. It is no part of a world's state: the vertices
/// give it, and measure_blocks writes it. Rows are written in place up to the limit and never appended.
struct VertexBlocks : Table<VertexBlocks> {
    using Table::Table;
    CULLET_TABLE(vertex_blocks);
    static constexpr bool kIsDerived = true;
    Column<uint8_t> sums{*this, "sums", "1", Keep::Scratch};  // BlockSums: what the rest of the row is
    Column<uint8_t> pinned_count{*this, "pinned_count", "1", Keep::Scratch};
    Column<std::array<float, 6>> box{*this, "box", "m", Keep::Scratch};  // low, high; low > high: none is live
    Column<double> mass{*this, "mass", "kg", Keep::Scratch};
    Column<Vec3d> first{*this, "first", "kg m", Keep::Scratch};     // sum of m x
    Column<Sym3d> second{*this, "second", "kg m2", Keep::Scratch};  // sum of m x x^T
    /// From put_back to clear_run: some vertex of it was in the cut-out, and all of its vertices have their velocities.
    /// The vertices of other blocks move with the rest of the body, and their velocities are not written.
    Column<uint8_t> moves{*this, "moves", "1", Keep::Scratch};
};

}  // namespace cullet
