// The hidden step against formulas, conservation laws and plain loops.
#include "components/state.hpp"
#include "systems/models/thick_shell/hidden/integrate_packs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "engine/random.hpp"
#include "engine/simd.hpp"
#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/models/thick_shell/hidden/energy.hpp"
#include "systems/models/thick_shell/hidden/start_hidden.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/models/thick_shell/stiffness/element_stiffness.hpp"
#include "tests/support/shell_meshes.hpp"

namespace cullet::test {
namespace {

void set_displacement(ShellView shell, uint32_t v, Vec3 u) {
    shell.state.vertices.displacement.set(shell.vertex(v), u);
    for (int side = 0; side < 2; ++side) shell.state.vertices.probe.set(shell.vertex(v), {u.x, u.y, u.z, 0}, side);
}

void shake(ShellView shell, double size, double speed, uint64_t seed = 7) {
    const Random random{seed};
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const auto r = [&](uint64_t k) { return random.uniform(v, k) - 0.5; };
        set_displacement(shell, v, (size * Vec3d(r(0), r(1), r(2))).to_float());
        shell.state.vertices.velocity.set(shell.vertex(v), (speed * Vec3d(r(3), r(4), r(5))).to_float());
    }
}

/// Forces by loops over elements and hinges, in double.
std::vector<Vec3d> plain_forces(ShellView shell) {
    const ShellRows& s = shell.state;
    std::vector<Vec3d> f(shell.vertex_count());
    const PlaneStress c = plane_stress(s, shell.structure);
    const auto u = [&](uint32_t v) { return Vec3d(s.vertices.displacement[shell.vertex(v)]); };
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        const TriangleTerms t(s.triangle_springs, row, c);
        const auto& corner = s.elements.corner[row];
        double xx = 0, yy = 0, xy = 0;
        for (size_t k = 0; k < 3; ++k) {
            const double a = dot(t.x, u(corner[k])), b = dot(t.y, u(corner[k]));
            xx += t.g[k][0] * a, yy += t.g[k][1] * b, xy += t.g[k][1] * a + t.g[k][0] * b;
        }
        const double sx = c.c11 * xx + c.c12 * yy, sy = c.c12 * xx + c.c11 * yy, sxy = c.c33 * xy;
        const double a = t.volume * s.triangle_springs.scale[row];
        for (size_t k = 0; k < 3; ++k)
            f[corner[k]] -= a * ((sx * t.g[k][0] + sxy * t.g[k][1]) * t.x + (sxy * t.g[k][0] + sy * t.g[k][1]) * t.y);
    }
    for (uint32_t h = 0; h < shell.hinge_count(); ++h) {
        const uint32_t row = shell.hinge(h);
        const auto& v = s.hinges.vertex[row];
        const auto& g = s.hinges.gradient[row];
        double theta = 0;
        for (size_t k = 0; k < 4; ++k) theta += dot(Vec3d(g[3 * k], g[3 * k + 1], g[3 * k + 2]), u(v[k]) - u(v[0]));
        for (size_t k = 0; k < 4; ++k)
            f[v[k]] -= double{s.hinges.stiffness[row]} * s.hinges.scale[row] * theta *
                       Vec3d(g[3 * k], g[3 * k + 1], g[3 * k + 2]);
    }
    return f;
}

struct Fixture {
    State state;
    Row<Materials> material;
    Row<Structures> shell;
    Row<Tasks> task;
    Fixture(const ShellMesh& mesh, double thickness, const std::function<bool(Vec3d)>& pinned = {}, double scale = 1) {
        material = add_material(state, 70e9 * scale, 0.22, 2400);
        shell = make_test_shell(state, mesh, thickness, material, pinned, 64);
        task = make_test_task(state, shell);
    }
    ShellView view() { return {state, shell}; }
    void start(Vec3 velocity, Vec3 spin) {
        state.tasks.start_velocity.set(task, velocity);
        state.tasks.start_spin.set(task, spin);
        start_hidden(state, task);
    }
    uint64_t motion_hash() {
        const ShellView s = view();
        uint64_t hash = 0;
        for (int k = 0; k < 3; ++k) {
            hash = hash_bytes(state.vertices.displacement.lane(k) + s.vertices().first, 4 * s.vertex_count(), hash);
            hash = hash_bytes(state.vertices.velocity.lane(k) + s.vertices().first, 4 * s.vertex_count(), hash);
        }
        return hash;
    }
};

TEST(HiddenStep, EqualsTheElementLoopToFloatRounding) {
    Fixture f(sphere_mesh(8, 0.1), 0.005);
    const ShellView shell = f.view();
    shake(shell, 1e-6, 0);
    const auto force = plain_forces(shell);
    const HiddenStep step(shell, 1, 0, 0);
    integrate_packs(step, 0, step.pack_count);
    double largest = 0, error = 0;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        const Vec3d got = f.state.vertices.mass[row] * Vec3d(f.state.vertices.velocity[row]);
        largest = std::max(largest, length(force[v]));
        // v += f / m on top of 0
        error = std::max(error, length(got - force[v]));
    }
    EXPECT_GT(largest, 1.0);
    EXPECT_LT(error, 3e-6 * largest);
}

TEST(HiddenStep, RigidTranslationIsFreeOfForceToTheLastBit) {
    Fixture f(sphere_mesh(6, 0.1), 0.005);
    const ShellView shell = f.view();
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) set_displacement(shell, v, {2.5e-3f, -1.37e-3f, 7.7e-4f});
    const HiddenStep step(shell, 1e-6f, 1e-7f, 0);
    integrate_packs(step, 0, step.pack_count);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v)
        ASSERT_EQ(f.state.vertices.velocity[shell.vertex(v)], (Vec3{0, 0, 0})) << v;
}

TEST(HiddenStep, LinearRotationIsFreeOfForceToRounding) {
    Fixture f(sphere_mesh(6, 0.1), 0.005);
    const ShellView shell = f.view();
    double typical = 0, largest = 0;
    shake(shell, 1e-5, 0);
    for (const Vec3d& p : plain_forces(shell)) typical = std::max(typical, length(p));
    for (uint32_t v = 0; v < shell.vertex_count(); ++v)
        set_displacement(shell, v, cross({1e-4f, 2e-4f, -3e-4f}, f.state.vertices.rest[shell.vertex(v)]));
    for (const Vec3d& p : plain_forces(shell)) largest = std::max(largest, length(p));
    EXPECT_LT(largest, 1e-5 * typical);
}

/// Linearised angular momentum: sum m r0 x v about the origin.
Vec3d angular_momentum(const ShellView& shell) {
    Vec3d sum;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        sum += shell.state.vertices.mass[row] *
               cross(Vec3d(shell.state.vertices.rest[row]), Vec3d(shell.state.vertices.velocity[row]));
    }
    return sum;
}

TEST(HiddenStep, AFreeShakenShellKeepsMomentumAndItsEnergyIsBoundedOver10000Steps) {
    Fixture f(sphere_mesh(6, 0.1), 0.005);
    const ShellView shell = f.view();
    f.state.hidden_runs.damping_time[f.task] = 0;
    f.start({1, 2, 3}, {});
    // A dent's worth of deformation on top.
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const Vec3 p = f.state.vertices.rest[shell.vertex(v)];
        const float push = p.y > 0.06f ? -3.0f : 0.0f;
        f.state.vertices.velocity.set(shell.vertex(v), f.state.vertices.velocity[shell.vertex(v)] + Vec3{0, push, 0});
    }
    double scale = 0, angular_scale = 0;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const double p = f.state.vertices.mass[shell.vertex(v)] * length(f.state.vertices.velocity[shell.vertex(v)]);
        scale += p, angular_scale += 0.1 * p;
    }
    const Vec3d linear = momentum(shell), angular = angular_momentum(shell);
    const double start = task_energy(f.state, f.task).total();
    double least = start, most = start, last_quarter = 0, first_quarter = 0;
    for (int i = 0; i < 10000; ++i) {
        step_task(f.state, f.task);
        if (i % 20) continue;
        const double e = task_energy(f.state, f.task).total();
        least = std::min(least, e), most = std::max(most, e);
        if (i < 2500) first_quarter += e / 125;
        if (i >= 7500) last_quarter += e / 125;
    }
    printf("momentum %.2e angular %.2e energy %.5f..%.5f trend %.2e\n", length(momentum(shell) - linear) / scale,
           length(angular_momentum(shell) - angular) / angular_scale, least / start, most / start,
           last_quarter / first_quarter - 1);
    EXPECT_LT(length(momentum(shell) - linear), 1e-6 * scale);
    EXPECT_LT(length(angular_momentum(shell) - angular), 1e-5 * angular_scale);
    EXPECT_LT(most, 1.02 * start);
    EXPECT_GT(least, 0.98 * start);
    EXPECT_NEAR(last_quarter / first_quarter, 1, 1e-3);
}

TEST(HiddenStep, AllSimdLevelsGiveTheSameBits) {
    uint64_t expected = 0;
    int levels = 0;
    for (const SimdLevel level :
         {SimdLevel::Scalar, SimdLevel::Sse4, SimdLevel::Avx2, SimdLevel::Avx512, SimdLevel::Best}) {
        if (!set_simd_level(level)) continue;
        ++levels;
        Fixture f(sphere_mesh(7, 0.1), 0.005);
        f.start({1, 2, 3}, {10, -20, 5});
        shake(f.view(), 1e-6, 1);
        for (int i = 0; i < 100; ++i) step_task(f.state, f.task);
        const uint64_t hash = f.motion_hash();
        if (expected == 0) expected = hash;
        EXPECT_EQ(hash, expected) << "level " << static_cast<int>(level);
    }
    set_simd_level(SimdLevel::Best);
    EXPECT_GE(levels, 2);
}

TEST(HiddenStep, PacksMayRunInAnyOrder) {
    Fixture f(sphere_mesh(7, 0.1), 0.005), g(sphere_mesh(7, 0.1), 0.005);
    shake(f.view(), 1e-6, 1);
    shake(g.view(), 1e-6, 1);
    for (uint32_t i = 0; i < 10; ++i) {
        const HiddenStep forward(f.view(), 3e-7f, 4e-8f, i), shuffled(g.view(), 3e-7f, 4e-8f, i);
        integrate_packs(forward, 0, forward.pack_count);
        for (uint32_t p = 0; p < shuffled.pack_count; ++p)
            integrate_packs(shuffled, (p * 7 + i) % shuffled.pack_count, 1);
        ASSERT_NE(shuffled.pack_count % 7, 0u);
        ASSERT_EQ(f.motion_hash(), g.motion_hash());
    }
}

TEST(HiddenStep, ScalingTheBodyScalesTimeAlone) {
    // Twice the size at the same speed: strains equal, dt and u twice (bit for bit: a power of two).
    Fixture f(sphere_mesh(6, 0.125), 0.005), g(sphere_mesh(6, 0.25), 0.01);
    EXPECT_EQ(2 * f.state.hidden_runs.time_step[f.task], g.state.hidden_runs.time_step[g.task]);
    f.start({1, 2, 3}, {16, -32, 8});
    g.start({1, 2, 3}, {8, -16, 4});
    shake(f.view(), 1e-6, 1);
    shake(g.view(), 2e-6, 1);
    for (int i = 0; i < 50; ++i) step_task(f.state, f.task), step_task(g.state, g.task);
    const ShellView a = f.view(), b = g.view();
    double difference = 0, largest = 0;
    for (uint32_t v = 0; v < a.vertex_count(); ++v) {
        const Vec3 u = f.state.vertices.displacement[a.vertex(v)], w = g.state.vertices.displacement[b.vertex(v)];
        difference = std::max(difference, double{length(2.0f * u - w)});
        largest = std::max(largest, double{length(w)});
    }
    EXPECT_LT(difference, 1e-5 * largest);
}

// Case 10 of the thick shell note.
class PlateFrequency : public ::testing::TestWithParam<uint32_t> {};
TEST_P(PlateFrequency, IsWithinOnePercentOfTheory) {
    const uint32_t n = GetParam();
    const double side = 1, h = 0.01, e = 70e9, nu = 0.22, density = 2400;
    // Simply supported: the edge is held; hinges leave it free to turn. In-plane motion does not couple (flat).
    const auto edge = [&](Vec3d p) { return p.x < 1e-9 || p.y < 1e-9 || p.x > side - 1e-9 || p.y > side - 1e-9; };
    Fixture f(triangle_mesh(n, side, 0.09), h, edge);
    const ShellView shell = f.view();
    const double pi = std::numbers::pi;
    const double bending = e * h * h * h / (12 * (1 - nu * nu));
    const double omega = 2 * pi * pi / (side * side) * std::sqrt(bending / (density * h));
    // Start in the first mode's shape; project on it; a quarter period is the first zero, the third quarter the second.
    std::vector<double> shape(shell.vertex_count());
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const Vec3 p = f.state.vertices.rest[shell.vertex(v)];
        double sx, cx, sy, cy;
        sine_cosine(pi * p.x, sx, cx);
        sine_cosine(pi * p.y, sy, cy);
        shape[v] = edge(Vec3d(p)) ? 0 : sx * sy;
        set_displacement(shell, v, {0, 0, static_cast<float>(1e-4 * shape[v])});
    }
    f.state.hidden_runs.damping_time[f.task] = 0;
    const double dt = f.state.hidden_runs.time_step[f.task];
    const auto amplitude = [&] {
        double sum = 0;
        for (uint32_t v = 0; v < shell.vertex_count(); ++v)
            sum += f.state.vertices.mass[shell.vertex(v)] * shape[v] * f.state.vertices.displacement[shell.vertex(v)].z;
        return sum;
    };
    double previous = amplitude(), crossings[2];
    int found = 0;
    for (int i = 1; found < 2 && i < 100000; ++i) {
        step_task(f.state, f.task);
        const double now = amplitude();
        if ((now > 0) != (previous > 0)) crossings[found++] = (i - now / (now - previous)) * dt;
        previous = now;
    }
    ASSERT_EQ(found, 2);
    const double ratio = pi / (crossings[1] - crossings[0]) / omega;
    printf("%u edges a side: dt %.3g us, frequency / theory = %.4f\n", n, dt * 1e6, ratio);
    EXPECT_NEAR(ratio, 1, 0.01);
}
INSTANTIATE_TEST_SUITE_P(Edges, PlateFrequency, ::testing::Values(25u, 50u, 70u));

TEST(StiffnessRows, RebuiltRowsEqualAFullAssemblyAlsoAfterPacksMoved) {
    Fixture f(sphere_mesh(6, 0.1), 0.005), g(sphere_mesh(6, 0.1), 0.005);
    const ShellView shell = f.view();
    // No free slot anywhere: every row that grows moves its pack. Zero all lanes first.
    const Range packs = f.state.shells.packs[f.state.shell_of(f.shell)];
    std::vector<uint32_t> all(shell.vertex_count());
    std::iota(all.begin(), all.end(), 0u);
    for (uint32_t p = packs.first; p < packs.first + 5; ++p) {
        f.state.stiffness_packs.block_count[p] = f.state.stiffness_packs.link_count[p] = 0;
        f.state.stiffness_packs.block_capacity[p] = f.state.stiffness_packs.link_capacity[p] = 0;
    }
    std::reverse(all.begin(), all.end());
    const uint32_t used = f.state.shells.blocks[f.state.shell_of(f.shell)].count;
    ASSERT_TRUE(rebuild_rows(shell, all));
    EXPECT_GT(f.state.shells.blocks[f.state.shell_of(f.shell)].count, used);
    shake(shell, 1e-6, 1);
    shake(g.view(), 1e-6, 1);
    for (int i = 0; i < 10; ++i) step_task(f.state, f.task), step_task(g.state, g.task);
    EXPECT_EQ(f.motion_hash(), g.motion_hash());
}

TEST(StiffnessRows, OutOfSpareIsRefused) {
    Fixture f(sphere_mesh(4, 0.1), 0.005);
    const uint32_t p = f.state.shells.packs[f.state.shell_of(f.shell)].first;
    f.state.stiffness_packs.block_capacity[p] = f.state.stiffness_packs.block_count[p] = 0;
    f.state.shells.blocks[f.state.shell_of(f.shell)].capacity = f.state.shells.blocks[f.state.shell_of(f.shell)].count;
    const uint32_t zero = 0;
    EXPECT_FALSE(rebuild_rows(f.view(), {&zero, 1}));
}

TEST(StiffnessRows, RoomThatIsAskedForIsEnoughToAssemble) {
    Fixture f(sphere_mesh(6, 0.1), 0.005);
    const ShellView shell = f.view();
    const ShellRoom room = stiffness_room(shell, 64);
    EXPECT_GE(room.blocks, f.state.shells.blocks[f.state.shell_of(f.shell)].count);
    EXPECT_GE(room.links, f.state.shells.links[f.state.shell_of(f.shell)].count);
    f.state.shells.blocks[f.state.shell_of(f.shell)].capacity = room.blocks;
    f.state.shells.links[f.state.shell_of(f.shell)].capacity = room.links;
    EXPECT_TRUE(assemble_stiffness(shell));
}

TEST(Limits, AVertexMadeLightIsScaledToTheLimitAndTheRestStays) {
    Fixture f(sphere_mesh(6, 0.1), 0.005);
    const ShellView shell = f.view();
    const uint32_t light = 40;
    f.state.vertices.mass[shell.vertex(light)] *= 0.05;
    f.state.vertices.inverse_mass[shell.vertex(light)] *= 20;
    VertexList rows;
    limit_stiffness(shell, {&light, 1}, rows);
    EXPECT_LT(f.state.vertices.stiffness_scale[shell.vertex(light)], 0.2f);
    EXPECT_EQ(rows.count, 13u);  // itself, 6 neighbours, 6 corners opposite
    ASSERT_TRUE(rebuild_rows(shell, rows.span()));
    // omega_max did not rise by more than the margin: the old step is still below the limit 2 / omega_max.
    EXPECT_GT(stable_time_step(shell) / 0.6, f.state.shells.time_step[f.state.shell_of(f.shell)]);
    f.state.hidden_runs.damping_time[f.task] = 0.15f * f.state.hidden_runs.time_step[f.task];
    f.start({0, 0, 0}, {0, 0, 0});
    shake(shell, 1e-6, 1);
    const double start = task_energy(f.state, f.task).total();
    for (int i = 0; i < 2000; ++i) step_task(f.state, f.task);
    EXPECT_FALSE(is_blown_up(task_energy(f.state, f.task), start));
}

}  // namespace
}  // namespace cullet::test
