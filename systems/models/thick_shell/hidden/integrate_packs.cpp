#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "systems/models/thick_shell/hidden/integrate_packs.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <algorithm>

#include "systems/models/thick_shell/hidden/integrate_packs.hpp"
#include "systems/models/thick_shell/hidden/integrate_pairs.hpp"
#include "systems/models/thick_shell/hidden/pack_step-inl.hpp"
#include "systems/models/thick_shell/stiffness/pair_cells.hpp"

HWY_BEFORE_NAMESPACE();
namespace cullet {
namespace HWY_NAMESPACE {

/// Rows `lane` to lane + kStep of the pack.
HWY_INLINE void integrate_lanes(const HiddenStep& step, uint32_t pack, uint32_t lane) {
    const Floats d;
    const uint32_t v = pack * kLanes + lane;
    const V3 own = load_points(step.probe + v);
    V3 force{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    // Each slot asks for the slot of its number in a later pack: packs may stand anywhere in the range.
    const uint32_t ahead = std::min(pack + kPacksAhead, step.pack_count - 1);
    const StiffnessBlock *block = step.blocks + step.first_block[pack],
                         *later_block = step.blocks + step.first_block[ahead];
    for (const StiffnessBlock* end = block + step.block_count[pack]; block != end; ++block, ++later_block) {
        if (lane == 0) prefetch(later_block, sizeof(StiffnessBlock));
        const V3 w = gather(step.probe, block->neighbour + lane) - own;
        const auto row = [&](int r) {
            return V3{hn::Load(d, block->k[r] + lane), hn::Load(d, block->k[r + 1] + lane),
                      hn::Load(d, block->k[r + 2] + lane)};
        };
        force = add(force, {dot(row(0), w), dot(row(3), w), dot(row(6), w)});
    }
    const StiffnessLink *link = step.links + step.first_link[pack], *later_link = step.links + step.first_link[ahead];
    for (const StiffnessLink* end = link + step.link_count[pack]; link != end; ++link, ++later_link) {
        if (lane == 0) prefetch(later_link, sizeof(StiffnessLink));
        const V3 w = gather(step.probe, link->neighbour + lane) - own;
        const V3 column{hn::Load(d, link->column[0] + lane), hn::Load(d, link->column[1] + lane),
                        hn::Load(d, link->column[2] + lane)};
        const V3 row{hn::Load(d, link->row[0] + lane), hn::Load(d, link->row[1] + lane),
                     hn::Load(d, link->row[2] + lane)};
        force = add(force, scaled(dot(column, w), row));
    }
    advance(step, v, force);
}

void integrate_packs(const HiddenStep& step, uint32_t first_pack, uint32_t pack_count) {
    for (uint32_t pack = first_pack; pack < first_pack + pack_count; ++pack)
        for (uint32_t lane = 0; lane < kLanes; lane += kStep) integrate_lanes(step, pack, lane);
}

}  // namespace HWY_NAMESPACE
}  // namespace cullet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cullet {

HWY_EXPORT(integrate_packs);

void integrate_packs(const HiddenStep& step, uint32_t first_pack, uint32_t pack_count) {
    if (step.has_pair_cells) return integrate_pairs(step, first_pack, pack_count);
    HWY_DYNAMIC_DISPATCH(integrate_packs)(step, first_pack, pack_count);
}

HiddenStep::HiddenStep(ShellView shell, float time_step, float damping_time, uint32_t side)
    : dt(time_step), beta(damping_time) {
    ShellRows& state = shell.state;
    const uint32_t packs = shell.shells().packs[shell.row].first, first = shell.vertices().first;
    first_block = state.stiffness_packs.first_block.data() + packs;
    block_count = state.stiffness_packs.block_count.data() + packs;
    first_link = state.stiffness_packs.first_link.data() + packs;
    link_count = state.stiffness_packs.link_count.data() + packs;
    blocks = state.stiffness_blocks.block.data() + shell.shells().blocks[shell.row].first;
    links = state.stiffness_links.link.data() + shell.shells().links[shell.row].first;
    inverse_mass = state.vertices.inverse_mass.data() + first;
    for (int k = 0; k < 3; ++k) {
        u[k] = state.vertices.displacement.lane(k) + first;
        v[k] = state.vertices.velocity.lane(k) + first;
    }
    probe = state.vertices.probe.data(static_cast<int>(side & 1)) + first;
    next_probe = state.vertices.probe.data(static_cast<int>(~side & 1)) + first;
    pack_count = shell.shells().packs[shell.row].count;
    has_pair_cells = stores_pairs_once(shell.structures(), shell.structure);
}

}  // namespace cullet
#endif
