#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "systems/models/thick_shell/hidden/integrate_pairs.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <algorithm>

#include "systems/models/thick_shell/hidden/integrate_pairs.hpp"
#include "systems/models/thick_shell/hidden/pack_step-inl.hpp"
#include "systems/models/thick_shell/stiffness/pair_cells.hpp"

HWY_BEFORE_NAMESPACE();
namespace cullet {
namespace HWY_NAMESPACE {

/// Forces of a pair cell's vertices, and behind them a place for each lane, where what a pair between cells does to its
/// other end is thrown away: that cell computes it itself.
struct PairForces {
    alignas(64) Float4 force[kPairCellVertices + kLanes];
    alignas(64) uint32_t outside[kLanes];  // the places behind; Iota builds them anew for each slot, by way of memory
    uint32_t first, count;                 // vertices

    PairForces(uint32_t first_vertex, uint32_t vertex_count) : first(first_vertex), count(vertex_count) {
        std::fill(force, force + count + kLanes, Float4{});
        for (uint32_t lane = 0; lane < kLanes; ++lane) outside[lane] = count + lane;
    }
    /// Takes `share` from the neighbours, lane by lane, so that it is the same at every level where two lanes have the
    /// same neighbour.
    HWY_INLINE void take(V3 share, const uint32_t* neighbour, uint32_t lane) {
        const Indices d;
        alignas(64) uint32_t at[kLanes];
        // Neighbours outside wrap round to more than count.
        hn::Store(hn::Min(hn::Sub(hn::Load(d, neighbour), hn::Set(d, first)), hn::Load(d, outside + lane)), d, at);
        subtract_points(share, force, at);
    }
};

/// A pack's shares in all forces of its cell. Slots go before lanes, so that forces are summed in the same order at
/// every level.
HWY_INLINE void add_pack(const HiddenStep& step, uint32_t pack, PairForces& forces) {
    const Floats d;
    constexpr uint32_t kParts = kLanes / kStep;
    const uint32_t v = pack * kLanes;
    V3 own[kParts], sum[kParts];
    for (uint32_t part = 0; part < kParts; ++part) {
        own[part] = load_points(step.probe + v + part * kStep);
        sum[part] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    }
    const uint32_t ahead = std::min(pack + kPacksAhead, step.pack_count - 1);
    const StiffnessBlock *block = step.blocks + step.first_block[pack],
                         *later_block = step.blocks + step.first_block[ahead];
    for (const StiffnessBlock* end = block + step.block_count[pack]; block != end; ++block, ++later_block) {
        prefetch(later_block, sizeof(StiffnessBlock));
        for (uint32_t part = 0; part < kParts; ++part) {
            const uint32_t lane = part * kStep;
            const V3 w = gather(step.probe, block->neighbour + lane) - own[part];
            const auto k = [&](int i) { return hn::Load(d, block->k[i] + lane); };
            const V3 row0{k(0), k(1), k(2)}, row1{k(3), k(4), k(5)}, row2{k(6), k(7), k(8)};
            sum[part] = add(sum[part], {dot(row0, w), dot(row1, w), dot(row2, w)});
            forces.take(
                {dot({row0.x, row1.x, row2.x}, w), dot({row0.y, row1.y, row2.y}, w), dot({row0.z, row1.z, row2.z}, w)},
                block->neighbour + lane, lane);
        }
    }
    const StiffnessLink *link = step.links + step.first_link[pack], *later_link = step.links + step.first_link[ahead];
    for (const StiffnessLink* end = link + step.link_count[pack]; link != end; ++link, ++later_link) {
        prefetch(later_link, sizeof(StiffnessLink));
        for (uint32_t part = 0; part < kParts; ++part) {
            const uint32_t lane = part * kStep;
            const V3 w = gather(step.probe, link->neighbour + lane) - own[part];
            const V3 column{hn::Load(d, link->column[0] + lane), hn::Load(d, link->column[1] + lane),
                            hn::Load(d, link->column[2] + lane)};
            const V3 row{hn::Load(d, link->row[0] + lane), hn::Load(d, link->row[1] + lane),
                         hn::Load(d, link->row[2] + lane)};
            sum[part] = add(sum[part], scaled(dot(column, w), row));
            forces.take(scaled(dot(row, w), column), link->neighbour + lane, lane);
        }
    }
    for (uint32_t part = 0; part < kParts; ++part) {
        Float4* force = forces.force + (v - forces.first) + part * kStep;
        store_points(add(load_points(force), sum[part]), force);
    }
}

void integrate_pairs(const HiddenStep& step, uint32_t first_pack, uint32_t pack_count) {
    for (uint32_t first = first_pack; first < first_pack + pack_count; first += kPairCellPacks) {
        const uint32_t end = std::min(first + kPairCellPacks, step.pack_count);
        PairForces forces(first * kLanes, (end - first) * kLanes);
        for (uint32_t pack = first; pack < end; ++pack) add_pack(step, pack, forces);
        for (uint32_t v = 0; v < forces.count; v += kStep)
            advance(step, forces.first + v, load_points(forces.force + v));
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace cullet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cullet {

HWY_EXPORT(integrate_pairs);

void integrate_pairs(const HiddenStep& step, uint32_t first_pack, uint32_t pack_count) {
    HWY_DYNAMIC_DISPATCH(integrate_pairs)(step, first_pack, pack_count);
}

}  // namespace cullet
#endif
