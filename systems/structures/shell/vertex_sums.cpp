#include "systems/structures/shell/vertex_sums.hpp"

#include <algorithm>
#include <cmath>

namespace cullet {
namespace {

BlockSums state_of(const BlockView& shell, uint32_t block) {
    return static_cast<BlockSums>(shell.state.vertex_blocks.sums[block_row(shell, block)]);
}

void add_box(VertexSums& sums, Vec3 low, Vec3 high) {
    sums.low = {std::min(sums.low.x, low.x), std::min(sums.low.y, low.y), std::min(sums.low.z, low.z)};
    sums.high = {std::max(sums.high.x, high.x), std::max(sums.high.y, high.y), std::max(sums.high.z, high.z)};
}

VertexSums measure(const BlockView& shell, uint32_t block) {
    const Vertices& vertices = shell.state.vertices;
    const uint32_t first = shell.vertex(block * kVerticesPerBlock),
                   end = std::min(first + kVerticesPerBlock, shell.vertex(shell.vertex_count()));
    VertexSums sums;
    for (uint32_t row = first; row < end; ++row) {
        if (vertices.element[row] == kNone) continue;
        const Vec3 place = vertices.rest[row];
        const double mass = vertices.mass[row];
        const Vec3d x(place);
        sums.mass += mass;
        sums.first += mass * x;
        sums.second = sums.second + mass * outer(x);
        sums.pinned += vertices.is_pinned[row];
        add_box(sums, place, place);
    }
    return sums;
}

VertexSums read(const VertexBlocks& blocks, uint32_t row) {
    VertexSums sums;
    const auto& box = blocks.box[row];
    sums.mass = blocks.mass[row];
    sums.first = blocks.first[row];
    sums.second = blocks.second[row];
    sums.pinned = blocks.pinned_count[row];
    sums.low = {box[0], box[1], box[2]}, sums.high = {box[3], box[4], box[5]};
    return sums;
}

void write(VertexBlocks& blocks, uint32_t row, const VertexSums& sums) {
    blocks.mass[row] = sums.mass;
    blocks.first.set(row, sums.first);
    blocks.second[row] = sums.second;
    blocks.pinned_count[row] = static_cast<uint8_t>(sums.pinned);
    blocks.box[row] = {sums.low.x, sums.low.y, sums.low.z, sums.high.x, sums.high.y, sums.high.z};
    blocks.sums[row] = static_cast<uint8_t>(BlockSums::Known);
}

[[maybe_unused]] bool are_same(const VertexSums& a, const VertexSums& b) {
    const Sym3d &s = a.second, &t = b.second;
    return a.mass == b.mass && a.first == b.first && a.pinned == b.pinned && a.low == b.low && a.high == b.high &&
           s.xx == t.xx && s.yy == t.yy && s.zz == t.zz && s.xy == t.xy && s.xz == t.xz && s.yz == t.yz;
}

}  // namespace

// Also the blocks that its spare rows will fill.
void keep_vertex_sums(const ShellView& shell) {
    const Range& range = shell.vertices();
    const uint32_t blocks = (range.capacity + kVerticesPerBlock - 1) / kVerticesPerBlock;
    std::fill_n(shell.state.vertex_blocks.sums.data() + block_row(shell, 0), blocks,
                static_cast<uint8_t>(BlockSums::Outdated));
}

void outdate_block(const ShellView& shell, uint32_t vertex) {
    uint8_t& sums = shell.state.vertex_blocks.sums[block_row(shell, vertex / kVerticesPerBlock)];
    sums = static_cast<uint8_t>(std::min(BlockSums{sums}, BlockSums::Outdated));
}

void outdate_blocks(const ShellView& shell, const FragmentPart& part) {
    const Elements& elements = shell.state.elements;
    for (uint32_t e = part.first_element; e != kNone; e = elements.next[shell.element(e)])
        for (const uint32_t v : elements.corner[shell.element(e)]) outdate_block(shell, v);
}

bool keeps_vertex_sums(const BlockView& shell) {
    return shell.vertex_count() > 0 && state_of(shell, 0) != BlockSums::NotKept;
}

VertexSums block_sums(const ShellView& shell, uint32_t block) {
    const VertexBlocks& blocks = shell.state.vertex_blocks;
    const uint32_t row = block_row(shell, block);
    if (state_of(shell, block) != BlockSums::Known) return measure(shell, block);
    CULLET_ASSERT(are_same(read(blocks, row), measure(shell, block)),
                  "vertices of block %u of shell %u have changed, and its sums were kept", block, shell.row.index);
    return read(blocks, row);
}

void measure_outdated(const BlockView& shell) {
    if (!keeps_vertex_sums(shell)) return;
    for (uint32_t b = 0; b < block_count(shell); ++b)
        if (state_of(shell, b) == BlockSums::Outdated)
            write(shell.state.vertex_blocks, block_row(shell, b), measure(shell, b));
}

namespace {

bool are_all_known(const ShellView& shell) {
    for (uint32_t b = 0; b < block_count(shell); ++b)
        if (state_of(shell, b) != BlockSums::Known) return false;
    return shell.vertex_count() > 0;
}

/// Of known blocks, column by column: each sum in the order of the blocks, as by the row.
VertexSums sum_columns(const VertexBlocks& blocks, uint32_t first, uint32_t end) {
    VertexSums all;
    for (uint32_t row = first; row < end; ++row) {
        all.mass += blocks.mass[row];
        all.first += blocks.first[row];
    }
    for (uint32_t row = first; row < end; ++row) {
        const auto& box = blocks.box[row];
        all.second = all.second + blocks.second[row];
        all.pinned += blocks.pinned_count[row];
        add_box(all, {box[0], box[1], box[2]}, {box[3], box[4], box[5]});
    }
    return all;
}

}  // namespace

VertexSums vertex_sums(const ShellView& shell) {
    if (!CULLET_CHECKS_ON && are_all_known(shell))
        return sum_columns(shell.state.vertex_blocks, block_row(shell, 0), block_row(shell, block_count(shell)));
    VertexSums all;
    for (uint32_t b = 0; b < block_count(shell); ++b) {
        const VertexSums block = block_sums(shell, b);
        all.mass += block.mass;
        all.first += block.first;
        all.second = all.second + block.second;
        all.pinned += block.pinned;
        add_box(all, block.low, block.high);
    }
    return all;
}

double reach_of_block(const ShellView& shell, uint32_t block, Vec3 place) {
    constexpr double kRounded = 1.000001;
    const auto box = box_of_block(shell, block);
    if (box[0] > box[3]) return 0;  // none is live
    const auto reach = [&](uint32_t k, double at) { return std::max(box[k + 3] - at, at - box[k]); };
    return kRounded * length(Vec3d(reach(0, place.x), reach(1, place.y), reach(2, place.z)));
}

}  // namespace cullet
