// Mass, moments and bounds of a shell's vertices, block by block (components/vertex_blocks.hpp): a hit on a large body
// then looks at a row for 64 vertices, and at the vertices of those blocks alone that the last hit changed.
#pragma once
#include <algorithm>

#include "components/bodies.hpp"
#include "components/shell_groups.hpp"

namespace cullet {

using BlockView = ShellIn<MeasuredBlocks>;

/// Of live vertices, body frame. They add and subtract, but for the box.
struct VertexSums {
    double mass = 0;      // kg
    Vec3d first;          // sum of m x
    Sym3d second;         // sum of m x x^T
    uint32_t pinned = 0;  // how many are
    Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};

    Vec3d centre() const { return mass > 0 ? (1 / mass) * first : Vec3d{}; }
};

/// Sums of the shell's blocks are kept from here on: whoever changes rest, mass, pins or life of one of its vertices
/// calls outdate_block. For shells of large bodies that runs leave alone. Nothing is measured yet.
void keep_vertex_sums(const ShellView& shell);
/// Writes the sums of each block that is outdated, where they are kept: readers write nothing.
void measure_outdated(const BlockView& shell);
void outdate_block(const ShellView& shell, uint32_t vertex);
/// All that hold vertices of a listed part.
void outdate_blocks(const ShellView& shell, const FragmentPart& part);
bool keeps_vertex_sums(const BlockView& shell);

inline uint32_t block_count(const BlockView& shell) {
    return (shell.vertex_count() + kVerticesPerBlock - 1) / kVerticesPerBlock;
}
/// In VertexBlocks.
inline uint32_t block_row(const BlockView& shell, uint32_t block) {
    return shell.vertex(0) / kVerticesPerBlock + block;
}
/// Of one block. One that is outdated is looked through, for this reader alone: the same bits either way.
VertexSums block_sums(const ShellView& shell, uint32_t block);
/// Of the shell: of its blocks, added in order.
VertexSums vertex_sums(const ShellView& shell);

inline std::array<float, 6> box_of_block(const ShellView& shell, uint32_t block) {
    const VertexBlocks& blocks = shell.state.vertex_blocks;
    const uint32_t row = block_row(shell, block);
    if (blocks.sums[row] == static_cast<uint8_t>(BlockSums::Known)) return blocks.box[row];
    const VertexSums sums = block_sums(shell, block);
    return {sums.low.x, sums.low.y, sums.low.z, sums.high.x, sums.high.y, sums.high.z};
}
/// Square of the distance from the block's box to a place. It rounds as the squares of vertices' distances do, so that
/// no live vertex of the block is nearer, to the last bit.
inline float square_to_block(const ShellView& shell, uint32_t block, Vec3 place) {
    const auto outside = [](float low, float high, float at) { return std::max(std::max(low - at, at - high), 0.0f); };
    const auto box = box_of_block(shell, block);
    const float dx = outside(box[0], box[3], place.x), dy = outside(box[1], box[4], place.y),
                dz = outside(box[2], box[5], place.z);
    return dx * dx + dy * dy + dz * dz;
}
/// Above the distance of each of its live vertices, m.
double reach_of_block(const ShellView& shell, uint32_t block, Vec3 place);

}  // namespace cullet
