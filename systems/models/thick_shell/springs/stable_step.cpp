#include <algorithm>
#include <limits>

#include "systems/models/thick_shell/springs/edge_stiffness.hpp"
#include "systems/models/thick_shell/springs/give_springs.hpp"
#include "systems/models/thick_shell/springs/spring_lists.hpp"

namespace cullet {
namespace {

/// Row sums over the points of a pack: of stiffness in N/m, of damping in N s/m.
struct Sums {
    double stiffness[kLanes] = {}, damping[kLanes] = {};
    void add(uint32_t k, double spring, double damper) {
        stiffness[k] += 2 * spring;
        damping[k] += 2 * damper;
    }
};

// Undamped, dt^2 K < 4 with K = `stiffness` / m. The force of a damper is that of the speed one step earlier, which
// makes it dt^2 K + 2 dt C < 4 (a mode of ratio z: omega dt < 2 (sqrt(1 + z^2) - z)), with C = `damping` / m. Both
// matrices go by their row sums, so it holds for any mixture of springs.
double longest_step(double stiffness, double damping, double inverse_mass) {
    constexpr double kShare = 0.6, kDampedShare = 0.9;
    const double k = stiffness * inverse_mass, c = damping * inverse_mass;
    if (!(k > 0)) return std::numeric_limits<float>::max();
    return std::min(kShare * 2 / std::sqrt(k), kDampedShare * 4 / (c + std::sqrt(c * c + 4 * k)));
}

}  // namespace

// Row sums of the stiffness matrix over the mass of the point. A spring has two blocks of k in a row, a mid spring four
// of k / 4, a shear pair four of k. The gradients of e1 - e2 are unit vectors. Damping is along springs alone.
float stable_spring_step(const SpringView& view) {
    const ShellRows& state = view.state;
    const LayerSprings& layers = state.layer_springs;
    const double now = view.own().time_step[view.row];  // slots hold c over it
    double least = std::numeric_limits<float>::max();
    for (uint32_t p = 0; p < view.pack_count(); ++p) {
        Sums outer, inner;
        const uint32_t row = view.pack(p), first = state.spring_packs.first_slot[row];
        for (uint32_t i = first; i < first + state.spring_packs.slot_count[row]; ++i) {
            const SpringSlot& slot = state.spring_slots.slot[view.slot(i)];
            for (uint32_t k = 0; k < kLanes; ++k) {
                outer.add(k, double{slot.stiffness_rest[k]} * slot.inverse_rest[k], now * slot.damping[k]);
                if (!view.has_layers()) continue;
                const LayerSlot& more = state.layer_slots.slot[view.layer_slot(i)];
                inner.add(k, double{more.stiffness_rest[k]} * more.inverse_rest[k], now * more.damping[k]);
            }
        }
        for (uint32_t k = 0; k < kLanes; ++k) {
            const uint32_t v = p * kLanes + k;
            if (v >= view.shell.vertex_count()) break;
            if (!view.has_layers()) {
                const double inverse_mass = state.vertices.inverse_mass[view.shell.vertex(v)];
                least = std::min(least, longest_step(outer.stiffness[k], outer.damping[k], inverse_mass));
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
            const double damping = std::max(outer.damping[k], inner.damping[k]) + 2 * now * double{twins.damping[twin]};
            least = std::min(least, longest_step(std::max(outer.stiffness[k], inner.stiffness[k]) + shared, damping,
                                                 twins.inverse_mass[twin]));
        }
    }
    return static_cast<float>(least);
}

void set_spring_step(const SpringView& view, float time_step) {
    view.own().time_step[view.row] = time_step;
    for (uint32_t s = 0; s < view.spring_count(); ++s) write_spring(view, s);
    if (!view.has_layers()) return;
    for (uint32_t v = 0; v < view.shell.vertex_count(); ++v) measure_twin(view, v, false);
}

}  // namespace cullet
