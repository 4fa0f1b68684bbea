#include "systems/models/thick_shell/stiffness/pair_cells.hpp"

#include <algorithm>
#include <utility>

#include "systems/models/thick_shell/stiffness/stiffness_slots.hpp"

namespace cullet {
namespace {

constexpr uint32_t kLevelPasses = 8;  // later ones find nothing to move
uint32_t bound_of_cells = kPairedCells;

/// The pairs of one kind inside one pair cell, each with the end that stores it; a vertex has at most `most` of them.
/// Vertices are counted from the cell's first one.
template <uint32_t most>
struct PairCell {
    static constexpr uint32_t kMostPairs = kPairCellVertices * most / 2;  // a pair has two ends
    static_assert(kPairCellVertices <= 256 && most <= 256, "vertices and slots of a pair are kept as bytes");
    uint32_t count = 0;
    uint8_t owner[kMostPairs], other[kMostPairs], slots[kMostPairs];
    uint16_t used[kPairCellVertices] = {};  // slots of each lane, pairs between cells included

    /// Goes to the end that has less, the first where both have the same.
    void add(uint32_t a, uint32_t b, uint32_t slot_count) {
        if (used[b] < used[a]) std::swap(a, b);
        CULLET_ASSERT(count < kMostPairs, "%u pairs in one cell", count);
        owner[count] = static_cast<uint8_t>(a), other[count] = static_cast<uint8_t>(b);
        slots[count++] = static_cast<uint8_t>(slot_count);
        used[a] = static_cast<uint16_t>(used[a] + slot_count);
    }
    uint32_t width(uint32_t vertex) const {
        const uint32_t first = vertex / kLanes * kLanes;
        return *std::max_element(used + first, used + first + kLanes);
    }
    /// A pack is as wide as its widest lane: those hand pairs to the other end where that makes no pack wider.
    void level() {
        for (uint32_t pass = 0; pass < kLevelPasses; ++pass)
            for (uint32_t i = 0; i < count; ++i) {
                const uint32_t a = owner[i], b = other[i], then = used[b] + slots[i];
                if (used[a] < width(a) || then > width(b) || (a / kLanes == b / kLanes && then >= used[a])) continue;
                used[a] = static_cast<uint16_t>(used[a] - slots[i]);
                used[b] = static_cast<uint16_t>(then);
                std::swap(owner[i], other[i]);
            }
    }
};

/// Neighbours of one kind, each once, with the slots that the pair takes.
template <uint32_t most>
struct Neighbours {
    uint32_t count = 0;
    uint32_t vertex[most];
    uint32_t slots[most];

    void add(uint32_t v, bool takes_another) {
        uint32_t at = 0;
        while (at < count && vertex[at] != v) ++at;
        if (at == most) return;
        if (at == count) {
            vertex[count] = v;
            slots[count++] = 1;
        } else if (takes_another) {
            ++slots[at];
        }
    }
};

using NearNeighbours = Neighbours<kMostNeighbours>;
using OppositeNeighbours = Neighbours<kMostLinks>;  // a grain links all vertices of a triangle's hinges

/// Whom build_row would find; without a grain without the numbers. `row` is room for them.
void find_neighbours(const ShellView& shell, const PlaneStress& stress, uint32_t vertex, NearNeighbours& blocks,
                     OppositeNeighbours& links, VertexRow& row) {
    const ShellRows& state = shell.state;
    blocks.count = links.count = 0;
    Ring ring;
    collect_ring(shell, vertex, ring);
    for (uint32_t i = 0; i < ring.count; ++i)
        for (const uint32_t v : state.elements.corner[shell.element(ring.element[i])])
            if (v != vertex) blocks.add(v, false);
    if (stress.has_grain) {
        build_row(shell, stress, vertex, row);
        for (uint32_t i = 0; i < row.link_count; ++i) links.add(row.link[i].neighbour, true);
        return;
    }
    RingHinges hinges;
    collect_hinges(shell, ring, hinges);
    for (uint32_t i = 0; i < hinges.count; ++i) {
        const auto& v = state.hinges.vertex[shell.hinge(hinges.hinge[i])];
        if (v[2] == vertex) links.add(v[3], true);
        if (v[3] == vertex) links.add(v[2], true);
    }
}

template <uint32_t most>
void share(const Neighbours<most>& neighbours, uint32_t vertex, PairCell<most>& cell) {
    for (uint32_t i = 0; i < neighbours.count; ++i) {
        const uint32_t other = neighbours.vertex[i], own = vertex % kPairCellVertices;
        if (!are_in_one_pair_cell(vertex, other))
            cell.used[own] = static_cast<uint16_t>(cell.used[own] + neighbours.slots[i]);
        else if (vertex < other)
            cell.add(own, other % kPairCellVertices, neighbours.slots[i]);
    }
}

/// Slots for the pack's lanes, in which the pairs that each stores are named and the rest of the lane is its own.
template <class Slot>
bool lay_pack(Slots<Slot> slots, uint32_t pack, uint32_t width) {
    if (!slots.reserve(width, 0)) return false;
    for (; slots.count < width; ++slots.count)
        for (uint32_t lane = 0; lane < kLanes; ++lane) clear_slot(slots.at(slots.count), lane, pack * kLanes + lane);
    return true;
}

template <class Slot, uint32_t most>
void name_pairs(const ShellView& shell, const PairCell<most>& cell, uint32_t first_vertex,
                Slots<Slot> (*slots_of)(const ShellView& view, uint32_t vertex)) {
    uint16_t named[kPairCellVertices] = {};
    for (uint32_t i = 0; i < cell.count; ++i) {
        const uint32_t v = first_vertex + cell.owner[i];
        const Slots<Slot> slots = slots_of(shell, v / kLanes);
        for (uint32_t s = 0; s < cell.slots[i]; ++s)
            slots.at(named[cell.owner[i]]++).neighbour[v % kLanes] = first_vertex + cell.other[i];
    }
}

template <class Slot>
bool names(const Slots<Slot>& slots, uint32_t lane, uint32_t vertex) {
    for (uint32_t i = 0; i < slots.count; ++i)
        if (slots.at(i).neighbour[lane] == vertex) return true;
    return false;
}

template <class Slot>
bool is_others(const ShellView& shell, uint32_t vertex, uint32_t other,
               Slots<Slot> (*slots_of)(const ShellView& view, uint32_t vertex)) {
    return are_in_one_pair_cell(vertex, other) && !names(slots_of(shell, vertex / kLanes), vertex % kLanes, other) &&
           names(slots_of(shell, other / kLanes), other % kLanes, vertex);
}

}  // namespace

void set_paired_cells(uint32_t cells) {
    bound_of_cells = cells;
}
uint32_t paired_cells() {
    return bound_of_cells;
}

namespace {

struct CellWork {
    PairCell<kMostNeighbours> blocks;
    PairCell<kMostLinks> links;
    NearNeighbours near;
    OppositeNeighbours opposite;
    VertexRow row;
};

}  // namespace

bool lay_pair_cells(ShellView shell) {
    const uint32_t packs = shell.shells().packs[shell.row].count;
    const PlaneStress stress = plane_stress(shell.state, shell.structure);
    for (uint32_t first = 0; first < packs; first += kPairCellPacks) {
        const uint32_t end = std::min(first + kPairCellPacks, packs), first_vertex = first * kLanes;
        const Scratch<CellWork> work(shell.state.scratch);
        auto& [blocks, links, near, opposite, row] = *work;
        for (uint32_t v = first_vertex; v < std::min(end * kLanes, shell.vertex_count()); ++v) {
            find_neighbours(shell, stress, v, near, opposite, row);
            share(near, v, blocks);
            share(opposite, v, links);
        }
        blocks.level();
        links.level();
        for (uint32_t p = first; p < end; ++p) {
            const uint32_t own = p * kLanes - first_vertex;
            if (!lay_pack(block_slots(shell, p), p, blocks.width(own))) return false;
            if (!lay_pack(link_slots(shell, p), p, links.width(own))) return false;
        }
        name_pairs(shell, blocks, first_vertex, block_slots);
        name_pairs(shell, links, first_vertex, link_slots);
    }
    return true;
}

void drop_others_pairs(ShellView shell, uint32_t vertex, VertexRow& row) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < row.block_count; ++i) {
        if (is_others(shell, vertex, row.neighbour[i], block_slots)) continue;
        row.neighbour[kept] = row.neighbour[i];
        std::copy(row.k[i], row.k[i] + 9, row.k[kept++]);
    }
    row.block_count = kept;
    kept = 0;
    for (uint32_t i = 0; i < row.link_count; ++i)
        if (!is_others(shell, vertex, row.link[i].neighbour, link_slots)) row.link[kept++] = row.link[i];
    row.link_count = kept;
}

}  // namespace cullet
