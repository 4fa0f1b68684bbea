#include <algorithm>
#include <limits>

#include "systems/models/thick_shell/soft/soft_lanes.hpp"
#include "systems/models/thick_shell/soft/soft_loop.hpp"
#include "systems/models/thick_shell/soft/systems.hpp"
#include "systems/models/thick_shell/springs/spring_lists.hpp"

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

/// A spring that is strained beyond yield, or beyond what it bears, or has no length.
struct Flowing {
    const FlowingView& view;
    const FlowingTables& state;
    float yield, most, creep;

    void look_at(uint32_t spring) const {
        Springs& springs = state.springs;
        const uint32_t row = view.spring(spring), a = springs.a[row], b = springs.b[row];
        springs.length[row] = -1;
        if (a == kNone) return;
        const float rest = springs.rest_length[row], now = length(view.position(b) - view.position(a));
        const bool is_live = springs.stiffness[row] > 0 && state.vertices.element[view.shell.vertex(a)] != kNone;
        if (!is_live) return;
        if (rest > 0) springs.length[row] = now / rest - 1;
        if (!(yield > 0)) return;
        float plastic = springs.plastic_length[row];
        bool has_flowed = flow(now, rest, yield, most, creep, plastic);
        springs.plastic_length[row] = plastic;
        if (view.has_layers()) {
            LayerSprings& layers = state.layer_springs;
            const uint32_t layer = view.layer(spring);
            float inner = layers.inner_plastic[layer];
            has_flowed |= flow(length(view.twin_position(b) - view.twin_position(a)), layers.inner_length[layer], yield,
                               most, creep, inner);
            layers.inner_plastic[layer] = inner;
        }
        if (has_flowed) write_spring(view, spring);
    }
};

StrainLook look_of(const FlowingView& view, float yield, float most) {
    const FlowingTables& s = view.state;
    const uint32_t springs = view.spring(0);
    StrainLook look{};
    look.a = s.springs.a.data() + springs, look.b = s.springs.b.data() + springs;
    look.rest = s.springs.rest_length.data() + springs, look.plastic = s.springs.plastic_length.data() + springs;
    look.strain = s.springs.length.data() + springs;
    look.outer = s.vertices.probe.data(view.side()) + view.shell.vertex(0);
    look.yield = yield > 0 ? yield : std::numeric_limits<float>::max();
    look.most = most;
    if (!view.has_layers()) return look;
    look.inner_plastic = s.layer_springs.inner_plastic.data() + view.layer(0);
    look.inner = s.twins.position.data(view.side()) + view.twin(0);
    return look;
}

}  // namespace

// creep = 1 - exp(-dt / tau), here dt / (dt + tau): the implicit step, which needs no libm and never overshoots. A
// spring writes its own row and its own two slots. Springs.length is left with the strain against the cooked length:
// what tear_springs looks at.
void flow_springs(Rows<Springs> springs, Of<ShellSprings> of, Of<SoftBodies> soft_body, InChunks<FlowingTables> rows,
                  const SoftBodies& soft) {
    const FlowingView view(rows.set, of.row);
    const uint32_t s = soft_body.row.index;
    const float dt = float{kSubstepsAFlow} * view.own().time_step[view.row];
    const Flowing flowing{view, rows.set, soft.yield_strain[s], soft.break_strain[s], dt / (dt + kFlowTime)};
    const StrainLook look = look_of(view, flowing.yield, flowing.most);
    const uint32_t first = springs.first - view.own().springs[view.row].first, end = first + springs.count;
    for (uint32_t from = first; from < end; from += kMostLooked) {
        uint32_t found[kMostLooked];
        const uint32_t count = find_strained(look, from, std::min(kMostLooked, end - from), found);
        for (uint32_t i = 0; i < count; ++i) flowing.look_at(found[i]);
    }
}

}  // namespace cullet
