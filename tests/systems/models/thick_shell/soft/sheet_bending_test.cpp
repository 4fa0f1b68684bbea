// Hinges of sheets with a bending stiffness of their own, against the theory of plates and the laws of motion.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/random.hpp"
#include "sample_game/spring_truth.hpp"
#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/soft/systems.hpp"
#include "systems/models/thick_shell/springs/start_springs.hpp"
#include "tests/systems/models/thick_shell/soft/soft_world.hpp"

namespace cullet {
namespace {

constexpr BenchMaterial kSheet{1e7, 0.3, 1000};

void give_bending(State& state, float bending) {
    while (state.material_traits.size() < state.materials.size()) state.material_traits.append(1);
    state.material_traits.bending_stiffness[0] = bending;
}

void step(SpringBench& bench) {
    bench.step();
    bend_sheets(Of<ShellSprings>{bench.springs()}, bench.state());
}

/// Pushed up in the middle and down at both ends: two cantilevers back to back. Deflection over F L^3 / (3 D w).
double deflection(const StripSize& strip, double bending) {
    SpringSettings settings;
    SpringBench bench(bench_strip(strip.half_edges, strip.rows, strip.edge), strip.thickness, kSheet, settings);
    give_bending(bench.state(), static_cast<float>(bending));
    const double length = strip.half_edges * strip.edge;
    // A hundredth of the length, small beside what bends it out of its plane and large beside what floats lose.
    const double force = 0.01 * length * 3 * bending * strip.width() / (length * length * length);
    std::vector<uint32_t> middle, end;
    for (uint32_t v = 0; v < bench.size(); ++v) {
        const Vec3 p = bench.state().vertices.rest[bench.view().shell.vertex(v)];
        if (std::fabs(std::fabs(p.x) - length) < 0.1 * strip.edge) end.push_back(v);
        if (std::fabs(p.x) < 0.1 * strip.edge) middle.push_back(v);
    }
    for (const uint32_t v : middle) bench.load(v, {0, 0, 2 * force / static_cast<double>(middle.size())});
    for (const uint32_t v : end) bench.load(v, {0, 0, -2 * force / static_cast<double>(end.size())});
    const double omega = 3.52 / (length * length) * std::sqrt(bending / (kSheet.density * strip.thickness));
    const auto keep = static_cast<float>(1 - 2 * omega * bench.time_step());
    Vertices& vertices = bench.state().vertices;
    for (double t = 0; t < 12 / omega; t += bench.time_step()) {
        step(bench);
        for (uint32_t v = 0; v < bench.size(); ++v) {
            const uint32_t row = bench.view().shell.vertex(v);
            vertices.velocity.set(row, keep * vertices.velocity[row]);
        }
    }
    const auto height = [&](const std::vector<uint32_t>& of) {
        double sum = 0;
        for (const uint32_t v : of) sum += bench.middle(v).z;
        return sum / static_cast<double>(of.size());
    };
    return (height(middle) - height(end)) / (0.01 * length);
}

// Poisson's ratio of the lattice's hinges is -1/3, so a narrow strip bends by D (1 - 1/9): 1.125 of D alone.
TEST(SheetBending, ANarrowStripBendsByItsStiffness) {
    StripSize strip{16, 4, 0.01, 0.002};
    for (const double bending : {1e-3, 4e-3}) {
        const double found = deflection(strip, bending);
        std::printf("D %.0e N m: %.4f of F L^3 / (3 D w)\n", bending, found);
        EXPECT_NEAR(found, 1.125, 0.06) << bending;
    }
}

TEST(SheetBending, MomentaStayAndAFlatSheetIsAtRest) {
    SpringBench bench(bench_disc(6, 0.01), 0.001, kSheet, {});
    give_bending(bench.state(), 1e-4f);
    const auto bend = [&] {
        bench.state().shell_springs.steps[bench.springs()] += 64 - bench.view().own().steps[bench.springs()] % 64;
        bend_sheets(Of<ShellSprings>{bench.springs()}, bench.state());
    };
    bend();
    double fastest = 0;
    for (uint32_t v = 0; v < bench.size(); ++v) fastest = std::max(fastest, double{length(bench.velocity(v))});
    const Random random{5};
    for (uint32_t v = 0; v < bench.size(); ++v) {
        const auto off = [&](uint32_t k) { return static_cast<float>(random.uniform(v, k) - 0.5) * 0.004f; };
        bench.view().place(v, bench.view().position(v) + Vec3{off(0), off(1), off(2)});
        bench.set_velocity(v, {});
    }
    bend();
    const SpringMotion motion = motion_of(bench.view());
    double pushed = 0, crumpled = 0;
    for (uint32_t v = 0; v < bench.size(); ++v) {
        const double speed = length(bench.velocity(v));
        pushed += bench.state().vertices.mass[bench.view().shell.vertex(v)] * speed,
            crumpled = std::max(crumpled, speed);
    }
    EXPECT_GT(crumpled, 0);
    EXPECT_LT(fastest, 1e-5 * crumpled);
    EXPECT_LT(length(motion.momentum), 1e-5 * pushed);
    EXPECT_LT(length(motion.angular), 1e-5 * pushed * 0.06);
}

/// Energy of an undamped crumpled sheet over its start's, springs left out of the sum: they have a part of it, so only
/// growth tells. However stiff: what a substep cannot follow is bent softer.
TEST(SheetBending, NoStiffnessMakesASheetRunAway) {
    for (const float bending : {1e-6f, 1e-4f, 1e-2f, 1.0f, 1e9f}) {
        SpringBench bench(bench_disc(6, 0.01), 0.001, kSheet, {});
        give_bending(bench.state(), bending);
        const Random random{7};
        for (uint32_t v = 0; v < bench.size(); ++v)
            bench.set_velocity(v, {0, 0, static_cast<float>(random.uniform(v, 0) - 0.5)});
        const double start = motion_of(bench.view()).kinetic;
        double most = 0;
        for (int i = 0; i < 20000; ++i) {
            step(bench);
            most = std::max(most, motion_of(bench.view()).kinetic);
        }
        std::printf("D %.0e N m: kinetic energy at most %.3f of the start's, %.3f in the end\n", double{bending},
                    most / start, motion_of(bench.view()).kinetic / start);
        EXPECT_LE(most, 1.05 * start) << bending;
    }
}

// The value decides: a stiffer cloth over an edge of the same mesh hangs out farther.
TEST(SheetBending, AStifferClothHangsLessFarDown) {
    MaterialTable table;
    float lowest[2];
    int n = 0;
    for (const float bending : {1e-5f, 1e-2f}) {
        MaterialSettings cloth = table.find("cloth").value();
        cloth.bending_stiffness = bending;
        ASSERT_TRUE(table.change(cloth).ok());
        CookSettings settings;
        settings.material = "cloth", settings.materials = &table, settings.thickness = 0.0004f;
        settings.longest_edge = 100;
        const Mesh mesh = make_pane(0.4f, 0.025f);
        const Result<Model> model = cook(test::view_of_mesh(mesh), settings);
        ASSERT_TRUE(model.ok()) << model.error();
        // Level, held along one border.
        Settings falls = test::soft_settings();
        falls.gravity = {0, -9.81f, 0};
        World world = test::make_world(falls);
        const Box pin{{-1, -0.01f, -1}, {1, 0.03f, 1}};
        SpawnSettings spawn;
        spawn.pins = &pin, spawn.pin_count = 1;
        spawn.pose.orientation = {std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)};
        const Result<BodyId> body = world.spawn(world.add_model(*model).value(), spawn);
        ASSERT_TRUE(body.ok()) << body.error();
        for (int frame = 0; frame < 240; ++frame) world.step();
        const State& state = test::state_of(world);
        const Row<Bodies> row(body->index);
        const ShellView shell(const_cast<State&>(state), state.bodies.structure[row]);
        lowest[n] = 0;
        for (uint32_t v = 0; v < shell.vertex_count(); ++v)
            lowest[n] =
                std::min(lowest[n], rotate(state.bodies.orientation[row], state.vertices.rest[shell.vertex(v)]).y);
        ++n;
    }
    std::printf("lowest %.3f m with 1e-5 N m, %.3f m with 1e-2\n", double{lowest[0]}, double{lowest[1]});
    EXPECT_LT(lowest[0], -0.33f);
    EXPECT_GT(lowest[1], lowest[0] + 0.05f);
}

}  // namespace
}  // namespace cullet
