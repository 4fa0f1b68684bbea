// The contact patch: weights, stability bound, momentum between striker, body and pins.
#include "systems/models/thick_shell/hidden/contact.hpp"
#include "components/state.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "systems/models/thick_shell/hidden/energy.hpp"
#include "systems/models/thick_shell/hidden/start_hidden.hpp"
#include "tests/support/shell_meshes.hpp"

namespace cullet::test {
namespace {

struct Fixture {
    State state;
    Row<Structures> shell;
    Row<Tasks> task;
    Fixture(const ShellMesh& mesh, double thickness, const std::function<bool(Vec3d)>& pinned = {}) {
        shell = make_test_shell(state, mesh, thickness, add_material(state, 70e9, 0.22, 2400), pinned);
        task = make_test_task(state, shell);
    }
    ShellView view() { return {state, shell}; }
    uint32_t add_contact(Vec3 near, Vec3 normal, float striker_mass, float radius, float speed) {
        const uint32_t c = state.tasks.first_contact[task] + state.tasks.contact_count[task]++;
        float least = 1e30f;
        for (uint32_t v = 0; v < view().vertex_count(); ++v) {
            const float d = length(state.vertices.rest[view().vertex(v)] - near);
            if (d < least) least = d, state.task_contacts.vertex[c] = v;
        }
        state.task_contacts.normal.set(c, normal);
        state.task_contacts.striker_inverse_mass[c] = striker_mass > 0 ? 1 / striker_mass : 0;
        state.task_contacts.striker_radius[c] = radius;
        state.task_contacts.start_speed[c] = speed;
        return c;
    }
    double patch_stiffness(uint32_t c) {
        double sum = 0;
        for (uint32_t i = 0; i < state.task_contacts.patch_count[c]; ++i)
            sum += state.patch_vertices.stiffness[state.task_contacts.first_patch[c] + i];
        return sum;
    }
};

TEST(Contact, StiffnessIsTheWallsOrTheStabilityBoundWhicheverIsLess) {
    Fixture f(sphere_mesh(10, 0.1), 0.005);
    const uint32_t c = f.add_contact({0, 0.1f, 0}, {0, -1, 0}, 0, 0, 3);
    f.state.hidden_runs.time_step[f.task] = 1e-8f;
    build_patches(f.state, f.task);
    EXPECT_NEAR(f.patch_stiffness(c), 0.15 * 70e9 * 0.005, 1e3);
    f.state.hidden_runs.time_step[f.task] = 1e-5f;
    build_patches(f.state, f.task);
    double most = 0;
    const double total = f.patch_stiffness(c);
    for (uint32_t i = 0; i < f.state.task_contacts.patch_count[c]; ++i) {
        const uint32_t p = f.state.task_contacts.first_patch[c] + i;
        const uint32_t row = f.view().vertex(f.state.patch_vertices.vertex[p]);
        most = std::max(most, f.state.patch_vertices.stiffness[p] / f.state.vertices.mass[row]);
    }
    EXPECT_LT(total, 0.15 * 70e9 * 0.005);
    EXPECT_NEAR(most, 0.3 / 1e-10, 1e-5 * 0.3 / 1e-10);
}

TEST(Contact, APatchLiesOnOneSideOfAThinBodyAndWithinItsRadius) {
    // A flat ball: the other wall is nearer than r_c.
    ShellMesh mesh = sphere_mesh(10, 0.1);
    for (Vec3d& p : mesh.positions) p.y *= 0.05;
    Fixture f(mesh, 0.005);
    const uint32_t c = f.add_contact({0, 0.005f, 0}, {0, -1, 0}, 0, 0.2f, 3);
    build_patches(f.state, f.task);
    EXPECT_FLOAT_EQ(f.state.task_contacts.radius[c], 0.07f);
    EXPECT_GT(f.state.task_contacts.patch_count[c], 20u);
    for (uint32_t i = 0; i < f.state.task_contacts.patch_count[c]; ++i) {
        const uint32_t v = f.state.patch_vertices.vertex[f.state.task_contacts.first_patch[c] + i];
        EXPECT_GT(f.state.vertices.rest[f.view().vertex(v)].y, 0);
    }
}

TEST(Contact, AVertexOfSeveralPatchesIsPushedByOneOfThem) {
    Fixture f(grid_mesh(20, 0.2, 0.2), 0.005);
    for (int i = 0; i < 8; ++i) f.add_contact({0.06f + 0.01f * float(i), 0.1f, 0}, {0, 0, -1}, 0, 0.1f, 1);
    build_patches(f.state, f.task);
    std::vector<int> pushed(f.view().vertex_count());
    uint32_t most = 0;
    for (uint32_t c = 0; c < 8; ++c) {
        most = std::max(most, f.state.task_contacts.first_patch[c] + f.state.task_contacts.patch_count[c]);
        for (uint32_t i = 0; i < f.state.task_contacts.patch_count[c]; ++i) {
            const uint32_t p = f.state.task_contacts.first_patch[c] + i;
            if (f.state.patch_vertices.stiffness[p] > 0) ++pushed[f.state.patch_vertices.vertex[p]];
        }
    }
    EXPECT_EQ(*std::max_element(pushed.begin(), pushed.end()), 1);
    EXPECT_LE(most, kMostPatchVertices);
}

TEST(Contact, AWidePatchKeepsItsHeaviestWeights) {
    Fixture f(grid_mesh(60, 0.2, 0.2), 0.005);
    const uint32_t c = f.add_contact({0.1f, 0.1f, 0}, {0, 0, -1}, 0, 1.0f, 1);
    build_patches(f.state, f.task);
    EXPECT_EQ(f.state.task_contacts.patch_count[c], kMostPatchVertices);
}

TEST(Contact, StrikerBodyAndPinsKeepTheirMomentumToAMillionth) {
    const auto edge = [](Vec3d p) { return p.x < 1e-9 || p.x > 0.5 - 1e-9; };
    Fixture f(triangle_mesh(30, 0.5, 0.1), 0.004, edge);
    const float mass = 0.1f, speed = 8;
    const uint32_t c = f.add_contact({0.2f, 0.2f, 0}, {0, 0, -1}, mass, 0.02f, speed);
    build_patches(f.state, f.task);
    start_hidden(f.state, f.task);
    const Vec3d start = momentum(f.view());
    Vec3d pins;
    for (int i = 0; i < 1000; ++i) {
        pins += double{f.state.hidden_runs.time_step[f.task]} * pin_force(f.view(), static_cast<uint32_t>(i) & 1);
        step_task(f.state, f.task);
    }
    const double given = double{mass} * (speed - f.state.task_contacts.striker_speed[c]);
    EXPECT_GT(given, 0.1 * mass * speed);
    EXPECT_NEAR(f.state.task_contacts.impulse[c], given, 1e-6 * mass * speed);
    const Vec3d contact{0, 0, -given};
    EXPECT_GT(length(pins), 1e-3 * mass * speed);
    EXPECT_LT(length(momentum(f.view()) - start + pins - contact), 1e-6 * mass * speed);
}

TEST(Contact, ABouncingHitKeepsItsEnergy) {
    // A ball on a flat striker of 50 kg: a soft hit without damping comes back with what it brought.
    Fixture f(sphere_mesh(12, 0.1), 0.005);
    f.state.hidden_runs.damping_time[f.task] = 0;
    f.add_contact({0, -0.1f, 0}, {0, 1, 0}, 50, 0, 0);
    f.state.tasks.start_velocity.set(f.task, {0, -2, 0});
    build_patches(f.state, f.task);
    start_hidden(f.state, f.task);
    const double start = f.state.hidden_runs.start_energy[f.task];
    EXPECT_NEAR(start, 0.5 * f.state.structures.mass[f.shell] * 4, 1e-5 * start);
    double most = 0;
    for (int i = 0; i < 4000; ++i) {
        step_task(f.state, f.task);
        if (i % 64 == 0) most = std::max(most, task_energy(f.state, f.task).total());
    }
    const TaskEnergy end = task_energy(f.state, f.task);
    EXPECT_LT(most, 1.02 * start);
    EXPECT_NEAR(end.total(), start, 0.02 * start);
    EXPECT_EQ(end.contact, 0);
    EXPECT_GT(f.state.task_contacts.impulse[0], 1.5 * 2 * f.state.structures.mass[f.shell]);
    EXPECT_FALSE(is_blown_up(end, start));
}

TEST(Contact, WhatALiftPutsInIsNoEnergyOutOfNothing) {
    // A lift of infinite mass meets a ball at rest: all that the ball has came from it.
    Fixture f(sphere_mesh(12, 0.1), 0.005);
    f.state.hidden_runs.damping_time[f.task] = 0;
    f.add_contact({0, -0.1f, 0}, {0, 1, 0}, 0, 0, 2);
    build_patches(f.state, f.task);
    start_hidden(f.state, f.task);
    EXPECT_EQ(f.state.hidden_runs.start_energy[f.task], 0);
    TaskEnergy energy;
    for (int i = 0; i < 4000; ++i) {
        step_task(f.state, f.task);
        if (i % 64 != 63) continue;
        energy = task_energy(f.state, f.task);
        ASSERT_FALSE(is_blown_up(energy, 0)) << energy.total() << " J of " << energy.work << " J put in, step " << i;
    }
    EXPECT_NEAR(energy.total(), energy.work, 0.02 * energy.work);
    EXPECT_GT(energy.work,
              1.5 * 2 * 2 * f.state.structures.mass[f.shell]);  // impulse times speed; it leaves at up to 4 m/s
}

TEST(Contact, ASpringBelowItsYieldForceIsElasticAndBeyondItGivesWayAtThatForce) {
    const PatchSpring spring{1e6f, 4e6f, 1000};  // N/m, N/m, N: yields at 1 mm
    float crush = 0;
    for (const float depth : {-1e-3f, 0.2e-3f, 0.9e-3f, 0.3e-3f, 0.0f}) {
        EXPECT_FLOAT_EQ(spring.force(depth, crush), 1e6f * std::max(0.0f, depth));
        EXPECT_EQ(crush, 0);
    }
    for (const float depth : {1.5e-3f, 2e-3f, 5e-3f}) {
        EXPECT_FLOAT_EQ(spring.force(depth, crush), 1000);
        EXPECT_NEAR(crush, depth - 1e-3f, 1e-9f);
    }
}

TEST(Contact, WhatHasBeenCrushedReturnsTheSquareOfTheRestitutionAndNeverPulls) {
    const PatchSpring spring{1e6f, 4e6f, 1000};
    float crush = 0;
    spring.force(5e-3f, crush);
    double given_back = 0;
    const float step = 1e-6f;
    for (float depth = 5e-3f; depth > -1e-3f; depth -= step) {
        const float force = spring.force(depth, crush);
        EXPECT_GE(force, 0);
        given_back += double{force} * step;
    }
    const double elastic = 0.5 * 1000.0 * 1000.0 / 1e6;
    EXPECT_NEAR(given_back, elastic / 4, 0.01 * elastic);
    EXPECT_NEAR(spring.energy(5e-3f, crush), elastic / 4, 1e-4 * elastic);
    // Pressed again it meets the same line.
    EXPECT_FLOAT_EQ(spring.force(5e-3f, crush), 1000);
}

TEST(Contact, WhatIsCrushedStaysCrushedWhenPatchesAreLaidAnew) {
    Fixture f(grid_mesh(20, 0.2, 0.2), 0.005);
    f.state.materials.crush_strength[0] = 1e7f;
    const uint32_t c = f.add_contact({0.1f, 0.1f, 0}, {0, 0, -1}, 1, 0.02f, 3);
    build_patches(f.state, f.task);
    start_hidden(f.state, f.task);
    for (int i = 0; i < 400; ++i) step_task(f.state, f.task);
    const double speed = f.state.task_contacts.striker_speed[c];
    const auto crush_of = [&](uint32_t p) {
        return f.state.vertices.crush[f.view().vertex(f.state.patch_vertices.vertex[p])];
    };
    const uint32_t first = f.state.task_contacts.first_patch[c], count = f.state.task_contacts.patch_count[c];
    std::vector<float> crush, force;
    contact_forces(f.state, f.task);
    for (uint32_t p = first; p < first + count; ++p) {
        crush.push_back(crush_of(p)), force.push_back(f.state.patch_vertices.force[p]);
    }
    EXPECT_GT(*std::max_element(crush.begin(), crush.end()), 1e-5f);
    build_patches(f.state, f.task);
    contact_forces(f.state, f.task);
    for (uint32_t p = first; p < first + count; ++p) {
        EXPECT_EQ(crush_of(p), crush[p - first]);
        EXPECT_EQ(f.state.patch_vertices.force[p], force[p - first]);
    }
    EXPECT_LT(task_energy(f.state, f.task).total(), 0.99 * f.state.hidden_runs.start_energy[f.task]);
    EXPECT_LT(speed, 3);
}

TEST(Contact, TooLongAStepIsSeenByTheEnergyTest) {
    Fixture f(sphere_mesh(6, 0.1), 0.005);
    f.state.hidden_runs.time_step[f.task] *= 2.2f;
    f.state.hidden_runs.damping_time[f.task] = 0.15f * f.state.hidden_runs.time_step[f.task];
    f.add_contact({0, -0.1f, 0}, {0, 1, 0}, 0, 0, 0);
    f.state.tasks.start_velocity.set(f.task, {0, -2, 0});
    build_patches(f.state, f.task);
    start_hidden(f.state, f.task);
    bool is_seen = false;
    for (int i = 0; i < 2000 && !is_seen; ++i) {
        step_task(f.state, f.task);
        if (i % 64 == 0) is_seen = is_blown_up(task_energy(f.state, f.task), f.state.hidden_runs.start_energy[f.task]);
    }
    EXPECT_TRUE(is_seen);
}

}  // namespace
}  // namespace cullet::test
