#include "systems/models/thick_shell/quick/strained_edges.hpp"

#include "systems/models/thick_shell/hidden/crack_rules.hpp"

namespace cullet {

void StrainedEdges::add(const StrainedEdge& e) {
    if (count == most) {
        if (!is_before(e, edge[0])) return;
        std::pop_heap(edge, edge + count, is_before);
        --count;
    }
    edge[count++] = e;
    std::push_heap(edge, edge + count, is_before);
}

void StrainedEdges::sort() {
    std::sort_heap(edge, edge + count, is_before);
}

// Each spring is seen from both ends; the lower one tells, so that it is told once.
void find_strained_edges(const RegionView& region, uint32_t most, StrainedEdges& found) {
    const RunRows& state = region.state;
    const SpringView& view = region.springs;
    const Vertices& vertices = state.vertices;
    const MarkedPacks& packs = state.marked_packs;
    const uint32_t first_vertex = region.shell.vertex(0);
    const float limit = state.quick_runs.split_strain[region.task];
    const float squeeze = state.quick_runs.compression_limit[region.task];
    constexpr auto kLeastFactor = static_cast<float>(kLeastStrengthFactor);
    const float least = kLeastFactor * limit;
    const Float4* now = vertices.probe.data(view.side()) + first_vertex;
    found.count = 0;
    found.most = std::min(most, StrainedEdges::kMost);
    // Once there are enough, what a vertex's largest stretch must reach for one of its edges to be more urgent than the
    // least of them; a little lower, for roundings. Where nearly all is above the limit nine of ten are skipped by it.
    const auto bar_of = [&](uint32_t v) {
        if (found.count < found.most || squeeze > 0) return -2.0f;
        const float least_own = 0.5f * limit * (vertices.strength_factor[first_vertex + v] + kLeastFactor);
        return 0.9999f * found.edge[0].urgency * least_own;
    };
    for (uint32_t row = region.first_row(); row < region.first_row() + region.pack_count(); ++row) {
        const uint32_t pack = packs.pack[row], of_pack = view.pack(pack);
        const SpringSlot* slots = state.spring_slots.slot.data() + view.slot(state.spring_packs.first_slot[of_pack]);
        const uint32_t slot_count = state.spring_packs.slot_count[of_pack];
        for (uint32_t k = 0; k < kLanes; ++k) {
            const uint32_t v = pack * kLanes + k;
            if (!(now[v].w > least) && !(squeeze > 0)) continue;
            if (now[v].w < bar_of(v)) continue;
            if (vertices.is_start_banned[first_vertex + v]) continue;
            for (uint32_t i = 0; i < slot_count; ++i) {
                const SpringSlot& slot = slots[i];
                const uint32_t n = slot.neighbour[k];
                if (n <= v || !(slot.stiffness_rest[k] > 0)) continue;
                const float strain = slot.length[k] * slot.inverse_rest[k] - 1;
                const float own =
                    0.5f * limit *
                    (vertices.strength_factor[first_vertex + v] + vertices.strength_factor[first_vertex + n]);
                const float part = strain > 0 ? strain : squeeze > 0 ? -strain / squeeze : 0;
                if (!(part > own) || vertices.is_start_banned[first_vertex + n]) continue;
                found.add({own > 0 ? part / own : 1e30f, v, n});
            }
        }
    }
    found.sort();
}

}  // namespace cullet
