#include "systems/models/thick_shell/loops.hpp"

#include "systems/models/thick_shell/hidden/brittle_loop.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/models/thick_shell/quick/quick_loop.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/soft/soft_loop.hpp"
#include "systems/models/thick_shell/soft/soft_units.hpp"

namespace cullet {
namespace {

bool is_hidden(const RunRows& rows, uint32_t task) {
    return !is_quick_task(rows, task);
}
RunCost cost_of_hidden(const RunRows& rows, uint32_t task) {
    return {units_a_step(rows, task), units_of_birth(rows, task)};
}
bool is_large(const RunRows& rows, uint32_t task) {
    return rows.shells.vertices[rows.shell_of(rows.tasks.working[task])].count > kTeamVertices;
}

RunCost cost_of_quick(const RunRows& rows, uint32_t task) {
    return {quick_units_a_step(rows, task), quick_units_of_end(rows, task)};
}
bool has_large_region(const RunRows& rows, uint32_t task) {
    return kLanes * rows.hidden_runs.pack_count[task] > kTeamVertices;
}

uint32_t soft_count(const SoftRows& rows) {
    return rows.soft_bodies.size();
}
template <bool HasLayers>
std::optional<FrameRun> soft_run(const SoftRows& rows, uint32_t s) {
    const SoftBodies& soft = rows.soft_bodies;
    const ShellSprings& springs = rows.shell_springs;
    if (!soft.is_used[s] || !soft.is_awake[s]) return {};
    const Row<ShellSprings> row = springs_of(rows, Row<SoftBodies>(s));
    const bool has_layers = static_cast<SpringLayout>(springs.layout[row]) != SpringLayout::OneLayer;
    if (has_layers != HasLayers) return {};
    return FrameRun{springs.steps[row], soft.granted[s], soft.granted[s] * soft_units_a_substep(springs, row),
                    rows.shells.vertices[rows.shell_of(springs.structure[row])].count > kSoftTeamVertices};
}

}  // namespace

void register_loops(DamageModel& model) {
    model
        .loop<cost_of_hidden>("thick shell, brittle: 300 to 4,000 times a hit, on its own clock", make_brittle_loop(),
                              {call<is_hidden>, call<is_large>})
        .loop<cost_of_quick>("thick shell, quick: 8 to 100 times a hit", make_quick_loop(),
                             {call<is_quick_task>, call<has_large_region>, true});
    model.moves_each_frame<most_soft_bodies, soft_units_wanted, grant_soft>("soft body")
        .frame_loop("thick shell, ductile and elastic: 8 to 1,000 times a frame",
                    make_soft_loop(SpringLayout::OneLayer), {call<soft_count>, call<soft_run<false>>})
        .frame_loop("the same, of bodies with an inner and an outer layer", make_soft_loop(SpringLayout::Sandwich),
                    {call<soft_count>, call<soft_run<true>>});
}

}  // namespace cullet
