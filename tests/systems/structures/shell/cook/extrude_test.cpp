#include "systems/structures/shell/cook/extrude.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/support/shell_checks.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet {
namespace {

Surface prepared(const Mesh& mesh) {
    Result<Surface> surface = prepare_surface(mesh);
    EXPECT_TRUE(surface) << surface.error();
    return surface ? *surface : Surface{};
}

Extrusion extruded(const Surface& surface, double thickness, const ExtrusionSettings& settings = {}) {
    Result<Extrusion> shell = extrude(surface, thickness, settings);
    EXPECT_TRUE(shell) << shell.error();
    return shell ? *shell : Extrusion{};
}

void expect_sound(const Surface& surface, const Extrusion& shell, double thickness) {
    const test::ShellReport report = test::check_shell(surface, shell, thickness);
    EXPECT_TRUE(report.is_sound()) << report;
}

Mesh pleated(double amplitude) {
    return test::sheet_mesh(1, 1, 80, 8, [=](double x, double) { return amplitude * std::sin(30 * x); });
}

// A cup: one closed surface with an inside and an outside wall a tenth of its radius apart.
Mesh cup() {
    std::vector<Vec2> profile{{0, 0}};
    for (int k = 1; k <= 8; ++k) profile.push_back({0.1f * static_cast<float>(k) + 0.2f, 0});
    for (int k = 1; k <= 12; ++k) profile.push_back({1, 0.1f * static_cast<float>(k)});
    for (int k = 12; k >= 1; --k) profile.push_back({0.9f, 0.1f * static_cast<float>(k)});
    for (int k = 7; k >= 1; --k) profile.push_back({0.1f * static_cast<float>(k), 0.1f});
    profile.push_back({0, 0.1f});
    return test::lathe_mesh(profile, 40);
}

TEST(Extrude, EveryShapeAtEveryThicknessIsSound) {
    std::vector<Mesh> meshes{test::sphere_mesh(1, 3),
                             test::box_mesh({1, 1, 1}, 4),
                             test::box_mesh({1, 1, 0.05}, 6),
                             test::torus_mesh(1, 0.25, 40, 20),
                             test::torus_mesh(1, 0.05, 120, 8),
                             pleated(0.1),
                             cup(),
                             test::sheet_mesh(1, 1, 10, 10)};
    test::append(meshes[0], test::turned_inside_out(test::sphere_mesh(0.7, 2)), {0.2, 0, 0});  // hollow ball
    for (const Mesh& mesh : meshes) {
        const Surface surface = prepared(mesh);
        for (const double share : {0.003, 0.01, 0.05, 0.2, 1.0}) {
            const double thickness = share * surface.diagonal;
            const Extrusion shell = extruded(surface, thickness);
            SCOPED_TRACE(mesh.name + " of " + std::to_string(mesh.triangles.size()) + " triangles at " +
                         std::to_string(share));
            expect_sound(surface, shell, thickness);
            EXPECT_EQ(shell.statistics.depth_zero_vertices, 0u);
        }
    }
}

TEST(Extrude, TheChecksSeeAWallPushedThroughAnother) {
    const Surface surface = prepared(test::box_mesh({1, 1, 0.1}, 5));
    Extrusion shell = extruded(surface, 0.03);
    EXPECT_TRUE(test::check_shell(surface, shell, 0.03).is_sound());
    for (size_t v = 0; v < shell.depth.size(); ++v) shell.depth[v] *= 2;
    const test::ShellReport report = test::check_shell(surface, shell, 0.03);
    EXPECT_GT(report.beyond_cap + report.meeting, 0u);
    for (size_t v = 0; v < shell.depth.size(); ++v) shell.depth[v] *= 1.2;
    EXPECT_GT(test::check_shell(surface, shell, 0.03).meeting, 0u);
    for (size_t v = 0; v < shell.depth.size(); ++v) shell.depth[v] *= -1;
    EXPECT_GT(test::check_shell(surface, shell, 0.03).beyond_cap, 0u);
}

TEST(Extrude, OnASphereEveryDepthIsTheThicknessAndNothingIsSetBack) {
    const Surface surface = prepared(test::sphere_mesh(2, 4));
    const Extrusion shell = extruded(surface, 0.1);
    EXPECT_EQ(shell.statistics.collisions, 0u);
    for (uint32_t v = 0; v < surface.positions.size(); ++v) {
        EXPECT_NEAR(length(surface.positions[v] + shell.depth[v] * shell.direction[v]), 1.9, 1e-3);
        EXPECT_GT(-dot(shell.direction[v], normalised(surface.positions[v])), 0.9995);
        EXPECT_NEAR(shell.depth[v], 0.1, 1e-3);
    }
}

TEST(Extrude, OnAConvexBodyEveryDepthIsTheThicknessWithoutTheMitre) {
    ExtrusionSettings settings;
    settings.has_mitre = false;
    for (const Mesh& mesh : {test::sphere_mesh(1, 3), test::box_mesh({1, 1, 1}, 6)}) {
        const Surface surface = prepared(mesh);
        const Extrusion shell = extruded(surface, 0.05, settings);
        EXPECT_EQ(shell.statistics.collisions, 0u);
        for (const double d : shell.depth) EXPECT_NEAR(d, 0.05, 1e-12) << mesh.name;
    }
}

TEST(Extrude, TheMitreMakesTheWallsOfABoxAsThickAsAsked) {
    const Surface surface = prepared(test::box_mesh({1, 1, 1}, 8));
    const Extrusion shell = extruded(surface, 0.04);
    for (uint32_t v = 0; v < surface.positions.size(); ++v) {
        const Vec3d p = surface.positions[v] + shell.depth[v] * shell.direction[v];
        const double wall = std::min({p.x, p.y, p.z, 1 - p.x, 1 - p.y, 1 - p.z});
        EXPECT_NEAR(wall, 0.04, 0.04 * 0.02) << "vertex " << v;
    }
}

TEST(Extrude, BetweenParallelWallsTheDepthIsHalfTheGap) {
    const double gap = 0.1, step_min = gap / 2 / (64 * 5);
    const Surface surface = prepared(test::box_mesh({2, 2, gap}, 16));
    const Extrusion shell = extruded(surface, 0.4);
    size_t inside = 0;
    for (uint32_t v = 0; v < surface.positions.size(); ++v) {
        const Vec3d p = surface.positions[v];
        if (std::min({p.x, p.y, 2 - p.x, 2 - p.y}) < 0.3) continue;
        ++inside;
        EXPECT_NEAR(shell.depth[v], gap / 2, 0.02 * gap / 2 + step_min);
    }
    EXPECT_GT(inside, 100u);
}

TEST(Extrude, TwiceTheSameAndAnyNumberingGiveTheSameDepths) {
    Mesh two = test::torus_mesh(1, 0.2, 24, 12);
    test::append(two, test::sphere_mesh(0.3, 2), {0.1, 0.1, 0});
    for (const Mesh& mesh : {two, pleated(0.1), cup()}) {
        const Surface surface = prepared(mesh);
        const Extrusion expected = extruded(surface, 0.08 * surface.diagonal);
        for (const uint64_t seed : {0ull, 1ull, 2ull, 3ull}) {
            const Surface other = prepared(seed == 0 ? mesh : test::shuffled(mesh, seed));
            const Extrusion shell = extruded(other, 0.08 * other.diagonal);
            ASSERT_TRUE(std::equal(surface.positions.begin(), surface.positions.end(), other.positions.begin(),
                                   other.positions.end()));
            EXPECT_EQ(shell.depth, expected.depth) << "seed " << seed;
        }
    }
}

TEST(Extrude, TheShellScalesWithTheMesh) {
    const Mesh mesh = test::torus_mesh(1, 0.2, 30, 14);
    const Surface surface = prepared(mesh);
    const Extrusion shell = extruded(surface, 0.1);
    // Powers of two change no digit.
    for (const double factor : {std::ldexp(1.0, 40), std::ldexp(1.0, -40)}) {
        const Surface other = prepared(test::scaled(mesh, factor));
        const Extrusion same = extruded(other, 0.1 * factor);
        ASSERT_EQ(same.depth.size(), shell.depth.size());
        for (size_t v = 0; v < shell.depth.size(); ++v) EXPECT_EQ(same.depth[v], factor * shell.depth[v]);
    }
    for (const double factor : {1e9, 1e-9}) {
        const Surface other = prepared(test::scaled(mesh, factor));
        expect_sound(other, extruded(other, 0.1 * factor), 0.1 * factor);
    }
}

TEST(Extrude, OneTriangleATetrahedronAndTwoTrianglesGetDepth) {
    Mesh triangle;
    triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.triangles = {{0, 1, 2}};
    Mesh tetrahedron;
    tetrahedron.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    for (const Mesh& mesh : {triangle, tetrahedron, test::sheet_mesh(1, 1, 1, 1)}) {
        const Surface surface = prepared(mesh);
        const Extrusion shell = extruded(surface, 0.05);
        expect_sound(surface, shell, 0.05);
        EXPECT_EQ(shell.statistics.degenerate_elements, 0u);
        if (surface.border_edges.empty()) continue;
        for (const double d : shell.depth) EXPECT_NEAR(d, 0.05, 1e-12);
    }
}

TEST(Extrude, ThePleatsOfASheetStayApart) {
    for (const double amplitude : {0.02, 0.05, 0.15, 0.4}) {
        const Surface surface = prepared(pleated(amplitude));
        for (const double thickness : {0.01, 0.04, 0.15}) {
            const Extrusion shell = extruded(surface, thickness);
            SCOPED_TRACE(std::to_string(amplitude) + " by " + std::to_string(thickness));
            expect_sound(surface, shell, thickness);
            EXPECT_EQ(shell.statistics.degenerate_elements, 0u);
        }
    }
}

TEST(Extrude, ACubeWithAFinAndAnInnerWallStillGetsAShell) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},    {0, 0, 1},
                      {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {0.5f, 1, 2}, {0.5f, 0, 2}};
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                      {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {4, 5, 8}, {0, 3, 7}, {0, 7, 4}};
    const Surface surface = prepared(mesh);
    EXPECT_GT(surface.repairs.crowded_edges, 0u);
    const Extrusion shell = extruded(surface, 0.05);
    expect_sound(surface, shell, 0.05);
    double mean = 0;
    for (const double d : shell.depth) mean += d / static_cast<double>(shell.depth.size());
    EXPECT_GT(mean, 0.25 * 0.05);
}

TEST(Extrude, BothPyramidsOfABowTieGetDepth) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 1, 1}, {1, -1, 1}, {1, 0, -1}, {-1, 1, 1}, {-1, -1, 1}, {-1, 0, -1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}, {0, 5, 4}, {0, 6, 5}, {0, 4, 6}, {4, 5, 6}};
    const Surface surface = prepared(mesh);
    const Extrusion shell = extruded(surface, 0.05);
    expect_sound(surface, shell, 0.05);
    for (const double d : shell.depth) EXPECT_GT(d, 0.01);
}

TEST(Extrude, AOneSidedStripStaysFlat) {
    const Mesh strip = test::grid_mesh(41, 4, false, false, [](uint32_t i, uint32_t j) {
        const double u = 2 * test::kPi * (i % 40) / 40, w = (j - 1.5) * 0.2 * (i == 40 ? -1 : 1);
        const double r = 1 + w * std::cos(u / 2);
        return Vec3d(r * std::cos(u), r * std::sin(u), w * std::sin(u / 2));
    });
    const Surface surface = prepared(strip);
    const Extrusion shell = extruded(surface, 0.05);
    for (const double d : shell.depth) EXPECT_EQ(d, 0.0);
    for (const uint8_t flag : shell.is_degenerate_element) EXPECT_EQ(flag, 1);
}

TEST(Extrude, WithInconsistentWindingTheShellIsTheSame) {
    const Mesh mesh = test::torus_mesh(1, 0.3, 20, 10);
    Mesh mixed = mesh;
    for (size_t t = 0; t < mixed.triangles.size(); t += 5) std::swap(mixed.triangles[t][0], mixed.triangles[t][2]);
    EXPECT_EQ(extruded(prepared(mixed), 0.1).depth.size(), extruded(prepared(mesh), 0.1).depth.size());
    const Surface surface = prepared(mixed);
    expect_sound(surface, extruded(surface, 0.1), 0.1);
}

TEST(Extrude, BodiesThatTouchDoNotThinEachOther) {
    Mesh mesh = test::box_mesh({1, 1, 1}, 3);
    test::append(mesh, test::box_mesh({1, 1, 1}, 3), {1, 0, 0.25});
    const Surface surface = prepared(mesh);
    EXPECT_EQ(surface.repairs.independent_pairs, 1u);
    const Extrusion shell = extruded(surface, 0.05);
    expect_sound(surface, shell, 0.05);
    for (const double d : shell.depth) EXPECT_GT(d, 0.045);
}

TEST(Extrude, NestedBodiesKeepTheirDistance) {
    Mesh mesh = test::sphere_mesh(1, 3);
    test::append(mesh, test::turned_inside_out(test::sphere_mesh(0.9, 3)));
    const Surface surface = prepared(mesh);
    EXPECT_EQ(surface.repairs.cavities, 1u);
    const Extrusion shell = extruded(surface, 0.2);
    expect_sound(surface, shell, 0.2);
    for (const double d : shell.depth) EXPECT_NEAR(d, 0.05, 0.05 * 0.05);
}

TEST(Extrude, ASurfaceThatCrossesItselfIsBuiltAndSoundElsewhere) {
    // A grid bent into a loop that passes through itself.
    const Surface surface = prepared(test::grid_mesh(61, 6, false, false, [](uint32_t i, uint32_t j) {
        const double u = -2 + 4.0 * i / 60;
        return Vec3d(u * u * u - 2 * u, u * u, 0.2 * j + 0.03 * std::sin(3 * u));
    }));
    EXPECT_GT(surface.crossings.size(), 0u);
    const Extrusion shell = extruded(surface, 0.05);
    expect_sound(surface, shell, 0.05);
    const auto deep = std::count_if(shell.depth.begin(), shell.depth.end(), [](double d) { return d > 0.02; });
    EXPECT_GT(deep, static_cast<ptrdiff_t>(shell.depth.size() / 2));
}

TEST(Extrude, AThicknessThatIsNoLengthIsRefused) {
    const Surface surface = prepared(test::box_mesh({1, 1, 1}, 1));
    for (const double bad :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const Result<Extrusion> shell = extrude(surface, bad);
        ASSERT_FALSE(shell);
        EXPECT_NE(shell.error().find("thickness"), std::string::npos);
    }
    EXPECT_FALSE(extrude(Surface{}, 0.1));
    EXPECT_FALSE(extrude(surface, 0.1, ExtrusionSettings{0, 12, true, true}));
}

TEST(Tetrahedra, OfAPrismFillItAndAgreeWithItsVolumeForAnyNumbering) {
    const std::array<Vec3d, 3> outer{Vec3d(0, 0, 0), Vec3d(2, 0, 0), Vec3d(0, 3, 0)};
    const std::array<Vec3d, 3> inner{Vec3d(0, 0, -1), Vec3d(2, 0, -1), Vec3d(0, 3, -1)};
    std::array<uint32_t, 3> ids{4, 7, 9};
    do {
        const PrismTetrahedra tets = prism_tetrahedra(outer, inner, ids);
        EXPECT_NEAR(tets.total(), 3.0, 1e-14);
        for (size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(tets.volume[k], 1.0, 1e-14);
            std::array<Vec3d, 3> flat = inner;
            flat[tets.flattens[k]] = outer[tets.flattens[k]];
            EXPECT_EQ(prism_tetrahedra(outer, flat, ids).volume[k], 0.0);
        }
    } while (std::next_permutation(ids.begin(), ids.end()));
}

}  // namespace
}  // namespace cullet
