#include "systems/models/thick_shell/hidden/start_explosions.hpp"

#include "systems/bodies/blows.hpp"
#include "systems/models/thick_shell/hidden/energy.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/structures/shell/explosion.hpp"

namespace cullet {
namespace {

/// Where the forces of a run are evaluated, after its velocities have changed; on both sides.
void aim_probes(ShellView shell, float damping_time) {
    Vertices& vertices = shell.state.vertices;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        const Vec3 probe = vertices.displacement[row] + damping_time * vertices.velocity[row];
        for (int side = 0; side < 2; ++side) vertices.probe.set(row, {probe.x, probe.y, probe.z, 0}, side);
    }
}

}  // namespace

void start_explosions(RunRows& state, const Blows& blows, Row<Tasks> task) {
    const ShellView shell(state, state.tasks.working[task]);
    bool is_kicked = false;
    for (uint32_t b = 0; b < blows.size(); ++b) {
        if (blows.task[b] != task.index || !is_kind(blows, b, BlowKind::Explosion)) continue;
        kick_vertices(shell, explosion_of(blows, b));
        is_kicked = true;
    }
    // In the quick mode a probe is where the point stands, and what it starts with is summed up behind this.
    if (!is_kicked || is_quick_task(state, task)) return;
    aim_probes(shell, state.hidden_runs.damping_time[task]);
    state.hidden_runs.start_energy[task] = task_energy(state, task).total();
}

}  // namespace cullet
