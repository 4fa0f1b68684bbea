#include "systems/structures/shell/cook/build_shell.hpp"
#include "components/state.hpp"

#include <gtest/gtest.h>

#include <set>

#include "systems/structures/shell/cook/apply_pins.hpp"
#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/prism.hpp"
#include "tests/support/sample_shells.hpp"

namespace cullet {
namespace {

constexpr double kPi = 3.14159265358979323846;

Row<Structures> build(State& state, const SampleSurface& surface) {
    const Result<Row<Structures>> built = build_shell(state, surface.source(), sample_material(state));
    EXPECT_TRUE(built.ok()) << built.error();
    return built.ok() ? built.value() : Row<Structures>{};
}

TEST(BuildShell, ASphereHasTheMassCentreAndInertiaOfAHollowBall) {
    State state;
    const double radius = 0.2, depth = 0.02, inner = radius - depth;
    SampleSurface surface = sample_sphere(radius, depth, 5);
    for (Vec3d& p : surface.position) p += Vec3d(1, 2, 3);
    const Row<Structures> shell = build(state, surface);
    const auto power = [](double x, int n) { return n == 3 ? x * x * x : x * x * x * x * x; };
    const double mass = 2400 * 4 * kPi / 3 * (power(radius, 3) - power(inner, 3));
    const double inertia = 2400 * 8 * kPi / 15 * (power(radius, 5) - power(inner, 5));
    EXPECT_NEAR(state.structures.mass[shell] / mass, 1, 2e-3);  // the facets
    EXPECT_NEAR(length(state.structures.centre[shell] - Vec3d(1, 2, 3)), 0, 1e-6);
    EXPECT_NEAR(state.structures.inertia[shell].xx / inertia, 1, 4e-3);
    EXPECT_NEAR(state.structures.inertia[shell].zz / inertia, 1, 4e-3);
    EXPECT_NEAR(state.structures.inertia[shell].xy / inertia, 0, 1e-5);
    EXPECT_NEAR(state.shells.thickness[state.shell_of(shell)], depth, 1e-8);
    EXPECT_NEAR(state.structures.area[shell] / (4 * kPi * radius * radius), 1, 2e-3);
}

TEST(BuildShell, ASheetIsAPlateExactly) {
    State state;
    const Row<Structures> shell = build(state, sample_grid(0.5, 0.25, 20, 10, 0.0078125, 0.4));
    const double m = 2400 * 0.5 * 0.25 * 0.0078125;
    EXPECT_NEAR(state.structures.mass[shell] / m, 1, 1e-7);
    EXPECT_NEAR(state.structures.centre[shell].y, -0.00390625, 1e-9);
    const Sym3d inertia = state.structures.inertia[shell];
    EXPECT_NEAR(inertia.xx / (m / 12 * (0.25 * 0.25 + 0.0078125 * 0.0078125)), 1, 1e-6);
    EXPECT_NEAR(inertia.yy / (m / 12 * (0.25 * 0.25 + 0.5 * 0.5)), 1, 1e-6);
    EXPECT_NEAR(inertia.zz / (m / 12 * (0.5 * 0.5 + 0.0078125 * 0.0078125)), 1, 1e-6);
}

TEST(BuildShell, MassesOfElementsVerticesAndVolumeAgree) {
    State state;
    const ShellView shell(state, build(state, sample_vase(0.3, 0.005, 60, 50)));
    double elements = 0, vertices = 0, volume = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        elements += state.elements.mass[shell.element(e)];
        volume += prism_volume(load_prism(shell, e));
    }
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) vertices += state.vertices.mass[shell.vertex(v)];
    EXPECT_NEAR(vertices / elements, 1, 1e-12);
    EXPECT_NEAR(2400 * volume / elements, 1, 1e-12);
    EXPECT_NEAR(state.structures.mass[shell.structure] / elements, 1, 1e-12);
}

TEST(BuildShell, PaddingIsUnderATenthAndDeadAndCellsAreSmall) {
    for (const SampleSurface& surface :
         {sample_vase(0.3, 0.005, 60, 50), sample_sphere(0.2, 0.004, 5), sample_grid(0.5, 0.5, 40, 40, 0.004, 0.3)}) {
        State state;
        const ShellView shell(state, build(state, surface));
        uint32_t live = 0;
        for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
            const uint32_t row = shell.vertex(v);
            if (state.vertices.element[row] == kNone) {
                EXPECT_EQ(state.vertices.inverse_mass[row], 0);
                continue;
            }
            ++live;
            EXPECT_GT(state.vertices.inverse_mass[row], 0);
        }
        EXPECT_EQ(live, surface.position.size());
        EXPECT_LT(shell.vertex_count(), 1.1 * live);
        EXPECT_EQ(shell.vertex_count() % kLanes, 0u);
        const Range cells = state.structures.cells[shell.structure];
        uint32_t most = 0, sum = 0;
        for (uint32_t c = 0; c < cells.count; ++c) {
            most = std::max(most, state.cells.element_count[cells.first + c]);
            sum += state.cells.element_count[cells.first + c];
            EXPECT_LE(state.cells.point_count[cells.first + c], kMostCellPoints);
        }
        EXPECT_EQ(sum, shell.element_count());
        std::printf("%zu vertices, %u rows, %u cells, most elements in a cell %u, mean edge %.2f mm\n",
                    surface.position.size(), shell.vertex_count(), cells.count, most,
                    1e3 * static_cast<double>(state.shells.mean_edge[shell.row]));
    }
}

TEST(BuildShell, NeighboursAreNearInMemory) {
    State state;
    const ShellView shell(state, build(state, sample_vase(0.3, 0.005, 60, 160)));
    double sum = 0;
    uint32_t count = 0, far = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (int k = 0; k < 3; ++k) {
            const auto c = state.elements.corner[shell.element(e)];
            const double way = std::fabs(static_cast<double>(c[k]) - static_cast<double>(c[(k + 1) % 3]));
            sum += way;
            far += way > 1024;
            ++count;
        }
    std::printf("mean distance of an edge's ends in rows %.1f of %u, beyond 1,024 rows %.1f %%\n", sum / count,
                shell.vertex_count(), 100.0 * far / count);
    EXPECT_LT(sum / count, 0.06 * shell.vertex_count());
}

TEST(BuildShell, LinksCornersAndHingesAreSymmetric) {
    State state;
    const ShellView shell(state, build(state, sample_vase(0.3, 0.005, 30, 20)));
    std::set<uint32_t> hinges;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (int k = 0; k < 3; ++k) {
            const uint32_t row = shell.element(e), n = state.elements.neighbour[row][k];
            EXPECT_EQ(state.elements.edge_kind[row][k] == static_cast<uint8_t>(EdgeKind::Border), n == kNone);
            if (n == kNone) continue;
            const auto c = state.elements.corner[row], d = state.elements.corner[shell.element(n)];
            int back = 0;
            while (state.elements.neighbour[shell.element(n)][back] != e) ++back;
            EXPECT_EQ(c[k], d[(back + 1) % 3]);
            EXPECT_EQ(c[(k + 1) % 3], d[back]);
            const uint32_t h = state.elements.hinge[row][k];
            EXPECT_EQ(h, state.elements.hinge[shell.element(n)][back]);
            hinges.insert(h);
            const auto& v = state.hinges.vertex[shell.hinge(h)];
            EXPECT_EQ(std::min(v[0], v[1]), std::min(c[k], c[(k + 1) % 3]));
            EXPECT_EQ(std::max(v[0], v[1]), std::max(c[k], c[(k + 1) % 3]));
            EXPECT_TRUE((v[2] == c[(k + 2) % 3] && v[3] == d[(back + 2) % 3]) ||
                        (v[3] == c[(k + 2) % 3] && v[2] == d[(back + 2) % 3]));
        }
    EXPECT_EQ(hinges.size(), shell.hinge_count());
    EXPECT_EQ(*hinges.rbegin() + 1, shell.hinge_count());
}

TEST(BuildShell, PinsAreStatic) {
    State state;
    const ShellView shell(state, build(state, sample_grid(1, 1, 8, 8, 0.01)));
    EXPECT_FALSE(has_pins(shell));
    EXPECT_EQ(apply_pins(shell, {-1, -1, -0.51f}, {1, 1, -0.49f}), 9u);
    EXPECT_EQ(apply_pins(shell, {-1, -1, -0.51f}, {1, 1, -0.49f}), 0u);
    const uint32_t some[] = {0, 100000};
    apply_pins(shell, some);
    EXPECT_TRUE(has_pins(shell));
    sum_vertex_masses(shell);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        if (state.vertices.element[row] == kNone) continue;
        EXPECT_EQ(state.vertices.inverse_mass[row] == 0, state.vertices.is_pinned[row] == 1);
    }
}

TEST(BuildShell, OneTriangleWithoutDepthHasMassAndAHull) {
    State state;
    SampleSurface surface;
    surface.position = {{0, 0, 0}, {0, 0, 0.1}, {0.1, 0, 0}};
    surface.inward = {{0, -1, 0}, {0, -1, 0}, {0, -1, 0}};
    surface.depth = {0, 0, 0};
    surface.corner = {{0, 1, 2}};
    surface.wanted_depth = 0.01;
    link_elements(surface);
    const Row<Structures> shell = build(state, surface);
    EXPECT_NEAR(state.structures.mass[shell] / (2400 * 0.05 * 0.01 * 0.005), 1, 1e-6);
    EXPECT_NEAR(length(state.structures.centre[shell] - Vec3d(0.1 / 3, 0, 0.1 / 3)), 0, 1e-8);
    EXPECT_GT(determinant(state.structures.inertia[shell]), 0);
    EXPECT_EQ(state.validate(), "");
}

TEST(BuildShell, RefusesBadSourcesWithASentence) {
    State state;
    const Row<Materials> material = sample_material(state);
    const auto refusal = [&](const SampleSurface& s) {
        const auto built = build_shell(state, s.source(), material);
        EXPECT_FALSE(built.ok());
        return built.error();
    };
    const SampleSurface good = sample_grid(1, 1, 2, 2, 0.01);
    SampleSurface bad = good;
    bad.position[3].x = NAN;
    EXPECT_NE(refusal(bad).find("position 3 is not finite"), std::string::npos);
    bad = good;
    bad.corner[1][2] = 77;
    EXPECT_NE(refusal(bad).find("names vertex 77"), std::string::npos);
    bad = good;
    bad.neighbour[0][1] = 6;
    EXPECT_NE(refusal(bad).find("neighbour"), std::string::npos);
    bad = good;
    bad.depth[0] = -1;
    EXPECT_NE(refusal(bad).find("depth 0"), std::string::npos);
    bad = good;
    for (auto& n : bad.neighbour) n = {kNone, kNone, kNone};
    EXPECT_NE(refusal(bad).find("more than one fan"), std::string::npos);
    bad = good;
    bad.position.push_back({9, 9, 9}), bad.inward.push_back({0, 1, 0}), bad.depth.push_back(0);
    EXPECT_NE(refusal(bad).find("is in no element"), std::string::npos);
    EXPECT_NE(refusal(SampleSurface{}).find("at least one triangle"), std::string::npos);
    State small({.vertices = 64, .elements = 64});
    const auto built = build_shell(small, sample_grid(1, 1, 20, 20, 0.01).source(), sample_material(small));
    EXPECT_NE(built.error().find("Raise limits.vertices"), std::string::npos) << built.error();
}

TEST(BuildShell, TheSameSourceGivesTheSameBytes) {
    State a, b;
    const SampleSurface surface = sample_vase(0.3, 0.005, 40, 30);
    build(a, surface), build(b, surface);
    EXPECT_EQ(a.first_difference(b), "");
    EXPECT_EQ(a.hash(), b.hash());
}

}  // namespace
}  // namespace cullet
