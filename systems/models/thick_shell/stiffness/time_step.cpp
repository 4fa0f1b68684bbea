// The stable time step of the hidden run (thick shell note B7).
#include <algorithm>
#include <vector>

#include "engine/random.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/models/thick_shell/stiffness/pair_cells.hpp"

namespace cullet {
namespace {

/// Adds the forces of the assembled rows at displacements x, in double.
void multiply(const ShellView& shell, const std::vector<Vec3d>& x, std::vector<Vec3d>& force) {
    const StiffnessPacks& packs = shell.state.stiffness_packs;
    const StiffnessBlock* blocks = shell.state.stiffness_blocks.block.data() + shell.shells().blocks[shell.row].first;
    const StiffnessLink* links = shell.state.stiffness_links.link.data() + shell.shells().links[shell.row].first;
    const bool once = stores_pairs_once(shell.structures(), shell.structure);
    std::fill(force.begin(), force.end(), Vec3d());
    for (uint32_t v = 0; v < x.size(); ++v) {
        const uint32_t p = shell.shells().packs[shell.row].first + v / kLanes, lane = v % kLanes;
        Vec3d f;
        for (uint32_t s = 0; s < packs.block_count[p]; ++s) {
            const StiffnessBlock& b = blocks[packs.first_block[p] + s];
            const Vec3d d = x[b.neighbour[lane]] - x[v];
            const auto k = [&](int i) { return double{b.k[i][lane]}; };
            f += {k(0) * d.x + k(1) * d.y + k(2) * d.z, k(3) * d.x + k(4) * d.y + k(5) * d.z,
                  k(6) * d.x + k(7) * d.y + k(8) * d.z};
            if (once && are_in_one_pair_cell(v, b.neighbour[lane]))
                force[b.neighbour[lane]] -= {k(0) * d.x + k(3) * d.y + k(6) * d.z, k(1) * d.x + k(4) * d.y + k(7) * d.z,
                                             k(2) * d.x + k(5) * d.y + k(8) * d.z};
        }
        for (uint32_t s = 0; s < packs.link_count[p]; ++s) {
            const StiffnessLink& l = links[packs.first_link[p] + s];
            const Vec3d d = x[l.neighbour[lane]] - x[v];
            const Vec3d row(l.row[0][lane], l.row[1][lane], l.row[2][lane]);
            const Vec3d column(l.column[0][lane], l.column[1][lane], l.column[2][lane]);
            f += dot(column, d) * row;
            if (once && are_in_one_pair_cell(v, l.neighbour[lane])) force[l.neighbour[lane]] -= dot(row, d) * column;
        }
        force[v] += f;
    }
}

}  // namespace

float stable_time_step(ShellView shell) {
    constexpr int kIterations = 40;
    const Vertices& vertices = shell.state.vertices;
    const uint32_t count = shell.vertex_count();
    // Lanes beyond the last vertex name themselves: give them a place that stays zero.
    std::vector<Vec3d> x((count + kLanes - 1) / kLanes * kLanes), force(x.size());
    const Random random{0x6f6d656761ull};
    for (uint32_t v = 0; v < count; ++v)
        if (vertices.inverse_mass[shell.vertex(v)] > 0)
            x[v] = {random.uniform(v, 0) - 0.5, random.uniform(v, 1) - 0.5, random.uniform(v, 2) - 0.5};
    double omega_squared = 0;  // Rayleigh quotient x.Kx / x.Mx
    for (int i = 0; i < kIterations; ++i) {
        multiply(shell, x, force);
        double stiffness = 0, mass = 0, largest = 0;
        for (uint32_t v = 0; v < count; ++v) {
            const double inverse_mass = vertices.inverse_mass[shell.vertex(v)];
            if (!(inverse_mass > 0)) continue;
            stiffness -= dot(x[v], force[v]);
            mass += dot(x[v], x[v]) / inverse_mass;
            x[v] = -inverse_mass * force[v];
            largest = std::max(largest, dot(x[v], x[v]));
        }
        if (!(mass > 0) || !(stiffness > 0)) return 0;
        omega_squared = stiffness / mass;
        const double scale = 1 / std::sqrt(largest);
        for (Vec3d& p : x) p = scale * p;
    }
    return static_cast<float>(0.6 * 2 / std::sqrt(omega_squared));
}

}  // namespace cullet
