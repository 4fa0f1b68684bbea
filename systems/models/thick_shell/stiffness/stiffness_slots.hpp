// One vertex's share of the stiffness, and the slots of a pack that it is written to.
#pragma once
#include <algorithm>

#include "components/shell_rows.hpp"
#include "systems/models/thick_shell/stiffness/element_stiffness.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {

inline constexpr uint32_t kMostNeighbours = kMostRing + 2;
inline constexpr uint32_t kGrainLinks = 4;  // a triangle of the ring, of materials with a grain; of others one
inline constexpr uint32_t kMostLinks = kGrainLinks * kMostRing;

/// One vertex's share, before it is put into its lane. Summed in double over elements, then hinges, both ascending, so
/// that the pair's two blocks are transposes of each other and every way to this row gives the same bits.
struct VertexRow {
    struct Link {
        uint32_t neighbour;
        float row[3], column[3];
    };
    uint32_t block_count = 0, link_count = 0;
    uint32_t neighbour[kMostNeighbours];
    double k[kMostNeighbours][9];
    Link link[kMostLinks];

    double* block(uint32_t v) {
        uint32_t at = 0;
        while (at < block_count && neighbour[at] != v) ++at;
        if (at == block_count) {
            if (block_count == kMostNeighbours) return k[kMostNeighbours - 1];
            neighbour[block_count++] = v;
            std::fill(k[at], k[at] + 9, 0.0);
        }
        return k[at];
    }
};

/// All of the vertex's pairs, whoever stores them.
void build_row(const ShellView& shell, const PlaneStress& stress, uint32_t vertex, VertexRow& row);

inline void clear_slot(StiffnessBlock& slot, uint32_t lane, uint32_t vertex) {
    slot.neighbour[lane] = vertex;
    for (auto& k : slot.k) k[lane] = 0;
}
inline void clear_slot(StiffnessLink& slot, uint32_t lane, uint32_t vertex) {
    slot.neighbour[lane] = vertex;
    for (int k = 0; k < 3; ++k) slot.row[k][lane] = slot.column[k][lane] = 0;
}
inline void write_slot(StiffnessBlock& slot, uint32_t lane, const VertexRow& row, uint32_t i) {
    slot.neighbour[lane] = row.neighbour[i];
    for (int k = 0; k < 9; ++k) slot.k[k][lane] = static_cast<float>(row.k[i][k]);
}
inline void write_slot(StiffnessLink& slot, uint32_t lane, const VertexRow& row, uint32_t i) {
    slot.neighbour[lane] = row.link[i].neighbour;
    for (int k = 0; k < 3; ++k) slot.row[k][lane] = row.link[i].row[k], slot.column[k][lane] = row.link[i].column[k];
}

/// One kind of slot of one pack: where it is, how many are in use and how many it may have.
template <class Slot>
struct Slots {
    Range& range;     // of the shell
    Slot* data;       // of the table
    uint32_t& first;  // relative to the range
    uint16_t& count;
    uint16_t& capacity;

    Slot& at(uint32_t i) const { return data[range.first + first + i]; }

    /// Room for `wanted` slots, moved to the end of the range where there is not.
    bool reserve(uint32_t wanted, uint32_t spare) {
        if (wanted <= capacity) return true;
        const uint32_t room = wanted + spare;
        if (range.count + room > range.capacity) return false;
        const uint32_t from = range.first + first, to = range.first + range.count;
        std::copy(data + from, data + from + count, data + to);
        first = range.count;
        range.count += room;
        capacity = static_cast<uint16_t>(room);
        return true;
    }
    void write_lane(uint32_t pack, uint32_t lane, const VertexRow& row, uint32_t used) {
        for (; count < used; ++count)
            for (uint32_t l = 0; l < kLanes; ++l) clear_slot(at(count), l, pack * kLanes + l);
        for (uint32_t i = 0; i < count; ++i)
            if (i < used)
                write_slot(at(i), lane, row, i);
            else
                clear_slot(at(i), lane, pack * kLanes + lane);
        while (count > 0 && is_unused(pack, count - 1u)) --count;
    }
    bool is_unused(uint32_t pack, uint32_t i) const {
        for (uint32_t l = 0; l < kLanes; ++l)
            if (at(i).neighbour[l] != pack * kLanes + l) return false;
        return true;
    }
};

inline Slots<StiffnessBlock> block_slots(const ShellView& shell, uint32_t pack) {
    StiffnessPacks& packs = shell.state.stiffness_packs;
    const uint32_t p = shell.shells().packs[shell.row].first + pack;
    return {shell.shells().blocks[shell.row], shell.state.stiffness_blocks.block.data(), packs.first_block[p],
            packs.block_count[p], packs.block_capacity[p]};
}
inline Slots<StiffnessLink> link_slots(const ShellView& shell, uint32_t pack) {
    StiffnessPacks& packs = shell.state.stiffness_packs;
    const uint32_t p = shell.shells().packs[shell.row].first + pack;
    return {shell.shells().links[shell.row], shell.state.stiffness_links.link.data(), packs.first_link[p],
            packs.link_count[p], packs.link_capacity[p]};
}

}  // namespace cullet
