#include "sample_game/yardsticks.hpp"

#include <algorithm>

#include "components/state.hpp"
#include "engine/fp_mode.hpp"
#include "engine/profiler.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/models/thick_shell/hidden/integrate_packs.hpp"

namespace cullet {
namespace {

constexpr uint64_t kMeasureFor = 20'000'000;  // ns
constexpr double kUnitsAVertex = 5;
constexpr double kNominal = 2;  // ns (systems/costs.hpp)

}  // namespace

std::map<std::string, double> measure_yardsticks(const Model& model) {
    const Workbench& source = model.contents->state;
    // Solids and what does not crack have no rows for hidden steps.
    if (!is_shell(source.structures, model.contents->shell)) return {{"unit_ns", kNominal}};
    const Range vertices = source.shells.vertices[source.shell_of(model.contents->shell)];
    State state(
        cooking_limits(vertices.capacity, source.shells.elements[source.shell_of(model.contents->shell)].capacity));
    const char* full = "";
    const Row<Structures> row = import_shell(state, source, model.contents->shell, &full);
    if (!row.exists() || vertices.count == 0) return {};
    const FpMode mode;
    const ShellView shell(state, row);
    // A slow shake: no denormals, nothing grows.
    for (uint32_t v = 0; v < vertices.count; ++v)
        state.vertices.velocity.set(shell.vertex(v), {0.01f * static_cast<float>(v % 7), 0, 0.01f});
    const float dt = state.shells.time_step[state.shell_of(row)];
    uint64_t least = ~uint64_t{0};
    if (HiddenStep(shell, dt, 0, false).pack_count == 0) return {{"unit_ns", kNominal}};
    const uint64_t start = now_ns();
    for (uint32_t turn = 0; now_ns() - start < kMeasureFor; ++turn) {
        const HiddenStep step(shell, dt, 0.15f * dt, turn & 1);
        const uint64_t begin = now_ns();
        integrate_packs(step, 0, step.pack_count);
        least = std::min(least, now_ns() - begin);
    }
    return {{"unit_ns", static_cast<double>(least) / (kUnitsAVertex * vertices.count)}};
}

}  // namespace cullet
