#include "systems/models/metal_shell/loop.hpp"

#include "systems/models/metal_shell/systems.hpp"

namespace cullet::metal_shell {
namespace {

constexpr uint64_t kUnitsImpact = 400;  // a vertex: 0.75 to 1.05 microseconds on panels and cars
constexpr uint64_t kUnitsDented = 250;  // a vertex, where it is dented: copies, hulls, what collides, the drawing

}  // namespace

InnerLoop<TaskWorld> make_loop() {
    InnerLoop<TaskWorld> loop;
    loop.then<work_impact>().finish();
    return loop;
}

// Whether it will be dented nobody knows yet.
RunCost cost_of(Read<MetalRows> rows, uint32_t task) {
    const uint64_t vertices = rows.shell_rows.shells.vertices[rows.shell_rows.shell_of(rows.tasks.working[task])].count;
    return {kUnitsImpact * vertices, is_ahead(rows.tasks, task) ? 0 : kUnitsDented * vertices};
}

bool works_on(Read<MetalRows> rows, uint32_t task) {
    return metal_of(rows, rows.tasks.working[task]).exists();
}

}  // namespace cullet::metal_shell
