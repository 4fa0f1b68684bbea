#include <algorithm>

#include "systems/soft/soft_loop.hpp"
#include "systems/springs/spring_lists.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

constexpr float kFlowTime = 0.001f;    // s, tau_p of 6.8: in which a strain above yield falls to 1/e
constexpr float kLeastLength = 0.25f;  // of the cooked one: nothing is pressed shorter

// 6.8: e = |x| / Lp - 1; above yield Lp += creep (|e| - e_y) sign(e) Lp, |Lp / L0 - 1| at most what tears it. True: it
// has flowed.
bool flow(float now, float rest, float yield, float most, float creep, float& plastic) {
    if (!(plastic > 0)) return false;
    const float strain = now / plastic - 1, beyond = std::fabs(strain) - yield;
    if (!(beyond > 0)) return false;
    const float flowed = plastic * (1 + creep * (strain > 0 ? beyond : -beyond));
    const float kept = std::clamp(flowed, kLeastLength * rest, (1 + most) * rest);
    if (!(kept < plastic) && !(kept > plastic)) return false;
    plastic = kept;
    return true;
}

}  // namespace

// creep = 1 - exp(-dt / tau), here dt / (dt + tau): the implicit step, which needs no libm and never overshoots. A
// spring writes its own row and its own two slots. Springs.length is left with the strain against the cooked length:
// what tear_springs looks at.
void flow_springs(Rows<Springs> rows, OfSprings of, OfSoft soft_body, ShellTables shells, const SoftBodies& soft) {
    State& state = shells.state;
    const SpringView view(state, of.row);
    const uint32_t s = soft_body.row.index;
    const float yield = soft.yield_strain[s], most = soft.break_strain[s];
    const float dt = float{kSubstepsAFlow} * view.own().time_step[view.row], creep = dt / (dt + kFlowTime);
    const uint32_t first = view.own().springs[view.row].first;
    Springs& springs = state.springs;
    for (const uint32_t row : rows) {
        const uint32_t a = springs.a[row], b = springs.b[row];
        if (a == kNone) continue;
        const float rest = springs.rest_length[row], now = length(view.position(b) - view.position(a));
        const bool is_live = springs.stiffness[row] > 0 && state.vertices.element[view.shell.vertex(a)] != kNone;
        springs.length[row] = rest > 0 && is_live ? now / rest - 1 : -1;
        if (!(yield > 0) || !is_live) continue;
        float plastic = springs.plastic_length[row];
        bool has_flowed = flow(now, rest, yield, most, creep, plastic);
        springs.plastic_length[row] = plastic;
        if (view.has_layers()) {
            LayerSprings& layers = state.layer_springs;
            const uint32_t layer = view.layer(row - first);
            float inner = layers.inner_plastic[layer];
            has_flowed |= flow(length(view.twin_position(b) - view.twin_position(a)), layers.inner_length[layer], yield,
                               most, creep, inner);
            layers.inner_plastic[layer] = inner;
        }
        if (has_flowed) write_spring(view, row - first);
    }
}

}  // namespace cullet
