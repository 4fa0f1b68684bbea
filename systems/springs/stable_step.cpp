#include <algorithm>
#include <limits>

#include "systems/springs/edge_stiffness.hpp"
#include "systems/springs/give_springs.hpp"
#include "systems/springs/spring_lists.hpp"

namespace cullet {

// Row sums of the stiffness matrix over the mass of the point: a spring has two blocks of k in a row, a mid spring four
// of k / 4, a shear pair four of k, the gradients of e1 - e2 being unit vectors.
float stable_spring_step(const SpringView& view) {
    const State& state = view.state;
    const LayerSprings& layers = state.layer_springs;
    double most = 0;
    for (uint32_t p = 0; p < view.pack_count(); ++p) {
        double outer[kLanes] = {}, inner[kLanes] = {};
        const uint32_t row = view.pack(p), first = state.spring_packs.first_slot[row];
        for (uint32_t i = first; i < first + state.spring_packs.slot_count[row]; ++i) {
            const SpringSlot& slot = state.spring_slots.slot[view.slot(i)];
            for (uint32_t k = 0; k < kLanes; ++k) {
                const double stiffness = double{slot.stiffness_rest[k]} * slot.inverse_rest[k];
                outer[k] += 2 * stiffness;
                if (!view.has_layers()) continue;
                const LayerSlot& more = state.layer_slots.slot[view.layer_slot(i)];
                inner[k] += 2 * double{more.stiffness_rest[k]} * more.inverse_rest[k];
            }
        }
        for (uint32_t k = 0; k < kLanes; ++k) {
            const uint32_t v = p * kLanes + k;
            if (v >= view.shell.vertex_count()) break;
            if (!view.has_layers()) {
                most = std::max(most, outer[k] * state.vertices.inverse_mass[view.shell.vertex(v)]);
                continue;
            }
            VertexSprings list;
            collect_springs(view, v, list);
            const Twins& twins = state.twins;
            const uint32_t twin = view.twin(v);
            double shared = 2 * double{twins.stiffness_rest[twin]} * twins.inverse_rest[twin];
            for (uint32_t i = 0; i < list.count; ++i) {
                const uint32_t layer = view.layer(list.spring[i]);
                shared += layers.mid_stiffness[layer];
                shared += (view.layout() == SpringLayout::Sandwich ? 4 : 2) * double{layers.cross_stiffness[layer]};
            }
            most = std::max(most, (std::max(outer[k], inner[k]) + shared) * twins.inverse_mass[twin]);
        }
    }
    return most > 0 ? static_cast<float>(0.6 * 2 / std::sqrt(most)) : std::numeric_limits<float>::max();
}

void set_spring_step(const SpringView& view, float time_step) {
    view.own().time_step[view.row] = time_step;
    for (uint32_t s = 0; s < view.spring_count(); ++s) write_spring(view, s);
    if (!view.has_layers()) return;
    for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) measure_twin(view, v, false);
}

}  // namespace cullet
