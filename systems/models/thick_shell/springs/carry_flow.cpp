#include "systems/models/thick_shell/springs/carry_flow.hpp"

#include "systems/models/thick_shell/springs/edge_stiffness.hpp"

namespace cullet {
namespace {

using Flow = std::array<float, 2>;  // plastic over cooked length: outer, inner skin

/// A mean of those that are known.
struct Mean {
    Flow sum{};
    float count = 0;
    void add(const Flow& flow) {
        if (!(flow[0] > 0)) return;
        sum = {sum[0] + flow[0], sum[1] + flow[1]};
        count += 1;
    }
    Flow value() const { return count > 0 ? Flow{sum[0] / count, sum[1] / count} : Flow{1, 1}; }
};

Flow flow_of(const SpringView& view, uint32_t s) {
    const Springs& springs = view.state.springs;
    const uint32_t row = view.spring(s);
    const auto ratio = [](float plastic, float rest) { return rest > 0 ? plastic / rest : 1; };
    const float outer = ratio(springs.plastic_length[row], springs.rest_length[row]);
    if (!view.has_layers()) return {outer, outer};
    const LayerSprings& layers = view.state.layer_springs;
    return {outer, ratio(layers.inner_plastic[view.layer(s)], layers.inner_length[view.layer(s)])};
}

/// Of the element, or of those beside it.
Flow flow_at(const SpringView& view, uint32_t e) {
    const ElementSprings& own = view.state.element_springs;
    Mean mean;
    mean.add(own.flow[view.edges(e)]);
    if (mean.count > 0) return mean.value();
    for (const uint32_t other : view.state.elements.neighbour[view.shell.element(e)])
        if (other != kNone) mean.add(own.flow[view.edges(other)]);
    return mean.count > 0 ? mean.value() : Flow{};
}

}  // namespace

void remember_flow(const SpringView& view, uint32_t element) {
    ElementSprings& own = view.state.element_springs;
    Mean mean;
    for (const uint32_t s : own.spring[view.edges(element)])
        if (s < view.spring_count() && view.state.springs.a[view.spring(s)] != kNone) mean.add(flow_of(view, s));
    if (mean.count > 0) own.flow[view.edges(element)] = mean.value();
}

bool carry_flow(const SpringView& view, uint32_t s) {
    ShellRows& state = view.state;
    const uint32_t row = view.spring(s), element = state.springs.element[row];
    Mean mean;
    mean.add(flow_at(view, element));
    for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t other = state.elements.neighbour[view.shell.element(element)][k];
        if (other != kNone && state.element_springs.spring[view.edges(other)][0] != kAsleepSpring &&
            state.element_springs.spring[view.edges(element)][k] == s)
            mean.add(flow_at(view, other));
    }
    const Flow flow = mean.value();
    if (flow == Flow{1, 1}) return false;
    const bool keeps = view.own().keeps_lengths[view.row] & kKeepsLengths;
    const auto carry = [&](float& rest, float& plastic, float by) { keeps ? rest /= by : plastic *= by; };
    carry(state.springs.rest_length[row], state.springs.plastic_length[row], flow[0]);
    if (!view.has_layers()) return true;
    LayerSprings& layers = state.layer_springs;
    const uint32_t layer = view.layer(s);
    carry(layers.inner_length[layer], layers.inner_plastic[layer], flow[1]);
    if (!keeps) return true;
    // What stands between the layers is taken times the mean flow of both.
    const float both = 0.5f * (flow[0] + flow[1]);
    layers.mid_length[layer] /= both;
    for (float& length : layers.cross_length[layer]) length /= both;
    return true;
}

}  // namespace cullet
