#include "systems/models/thick_shell/soft/soft_units.hpp"

#include <algorithm>

#include "systems/models/thick_shell/soft/costs.hpp"
#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/springs/press_layers.hpp"

namespace cullet {
namespace {

struct Cost {
    uint64_t frame, substep;
};

Cost cost_of(const SoftRows& state, uint32_t s) {
    const Row<SoftBodies> row(s);
    const Row<ShellSprings> springs = springs_of(state, row);
    const uint64_t vertices = state.shells.vertices[state.shell_of(state.shell_springs.structure[springs])].count;
    return {vertices * kUnitsSoftFrame, soft_units_a_substep(state.shell_springs, springs)};
}

template <class F>
void for_each_awake(const SoftRows& state, F&& f) {
    const SoftBodies& soft = state.soft_bodies;
    for (uint32_t s = 0; s < soft.size(); ++s)
        if (soft.is_used[s] && soft.is_awake[s]) f(s, cost_of(state, s));
}

}  // namespace

uint64_t soft_units_a_substep(const ShellSprings& springs, Row<ShellSprings> row) {
    const uint64_t edges = springs.springs[row].count;
    const bool has_layers = static_cast<SpringLayout>(springs.layout[row]) != SpringLayout::OneLayer;
    return std::max<uint64_t>(edges * (has_layers ? kUnitsSoftTenPairs : kUnitsSoftTenSprings) / 10, 1) +
           units_of_energies(springs, row);
}

uint64_t soft_units_wanted(const SoftRows& state) {
    uint64_t sum = 0;
    for_each_awake(state,
                   [&](uint32_t s, Cost cost) { sum += cost.frame + cost.substep * state.soft_bodies.substeps[s]; });
    return sum;
}

uint64_t grant_soft(SoftRows& state, uint64_t units, uint64_t& slow_frames) {
    SoftBodies& soft = state.soft_bodies;
    uint64_t fixed = 0, steps = 0, used = 0;
    for_each_awake(state,
                   [&](uint32_t s, Cost cost) { fixed += cost.frame, steps += cost.substep * soft.substeps[s]; });
    const uint64_t left = units > fixed ? units - fixed : 0;
    for_each_awake(state, [&](uint32_t s, Cost cost) {
        const uint32_t wanted = soft.substeps[s];
        const auto share =
            steps > left ? static_cast<uint32_t>(double(wanted) * (double(left) / double(steps))) : wanted;
        soft.granted[s] = std::min(wanted, std::max(share, kLeastSubsteps));
        used += cost.frame + cost.substep * soft.granted[s];
        if (soft.granted[s] == wanted) return;
        ++soft.slow_frames[s];
        ++slow_frames;
    });
    return used;
}

float soft_seconds(const SoftBodies& soft, uint32_t row, float step_seconds) {
    const uint32_t granted = soft.granted[row], wanted = soft.substeps[row];
    return granted == wanted ? step_seconds : step_seconds * (static_cast<float>(granted) / static_cast<float>(wanted));
}

}  // namespace cullet
