// Quadratic elements over a cut lattice against what theory says (solid cooking note, section 5, T7 and T8).
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "systems/structures/tetrahedra/cook/cook_solid.hpp"
#include "sample_game/elastic_solve.hpp"
#include "tests/support/lattice_solids.hpp"

namespace cullet {
namespace {

constexpr ElasticSolid kStone{10e9, 0.2};

Solid bar(Vec3d half, double edge, int elements) {
    return fill_convex(box_planes(half), half, {.edge = edge, .elements = elements});
}

TEST(SolidElements, TheClippedBoxHasTheBoxsVolumeAndArea) {
    const Solid solid = bar({0.1, 0.05, 0.03}, 0.03, 2);
    EXPECT_NEAR(solid.volume, 8 * 0.1 * 0.05 * 0.03, 1e-12);
    EXPECT_NEAR(solid.area, 8 * (0.1 * 0.05 + 0.1 * 0.03 + 0.05 * 0.03), 1e-10);
    const SolidElements elements = make_elements(solid);
    double sum = 0;
    for (const SolidPart& part : elements.parts) sum += volume_of(part.moments);
    EXPECT_NEAR(sum, solid.volume, 1e-12);
    for (uint32_t c = 0; c < solid.cells.size(); ++c) {
        Vec3d middle;
        for (uint32_t p = elements.first_part[c]; p < elements.first_part[c + 1]; ++p)
            middle += volume_of(elements.parts[p].moments) / solid.cells[c].volume *
                      centroid_of(elements.parts[p].moments, elements, elements.elements[elements.parts[p].element]);
        ASSERT_LT(length(middle - solid.cells[c].centroid), 1e-9);
    }
}

TEST(SolidElements, ALinearDisplacementGivesTheSameStressInEveryCellCutOrNot) {
    for (const int size : {2, 4}) {
        const Solid solid = bar({0.1, 0.05, 0.03}, 0.03, size);
        const SolidElements elements = make_elements(solid);
        ElasticSolve solve(elements, kStone);
        solve.displacements.assign(elements.places.size() * 3, 0.0);
        const double strain[3][3] = {{1e-4, 3e-5, -2e-5}, {-1e-5, 2e-4, 4e-5}, {5e-5, -6e-5, -3e-4}};
        for (uint32_t n = 0; n < elements.places.size(); ++n)
            for (int i = 0; i < 3; ++i)
                for (int k = 0; k < 3; ++k)
                    solve.displacements[elements.plan.rank[n] * 3 + i] += strain[i][k] * elements.places[n][k];
        differentiate(elements, solve.sums, solve.displacements, solve.gradients);
        const double mu = kStone.shear(), sum = kStone.first_lame() * (1e-4 + 2e-4 - 3e-4);
        const Sym3d wanted{sum + 2e-4 * mu,    sum + 4e-4 * mu,     sum - 6e-4 * mu,
                           mu * (3e-5 - 1e-5), mu * (-2e-5 + 5e-5), mu * (4e-5 - 6e-5)};
        double worst = 0;
        for (const ElementPlace& probe : elements.probes) {
            const Sym3d off = stress_at(solve.gradients[probe.element], probe.at, kStone) - wanted;
            for (const double s : {off.xx, off.yy, off.zz, off.xy, off.xz, off.yz})
                worst = std::max(worst, std::fabs(s));
        }
        EXPECT_LT(worst, 1e-9 * wanted.yy) << size;
    }
}

TEST(SolidElements, APulledBarTakesTheEnergyOfTheory) {
    const Vec3d half{0.2, 0.05, 0.05};
    for (const double edge : {0.025, 0.05, 0.1}) {
        const Solid solid = bar(half, edge, 2);
        const SolidElements elements = make_elements(solid);
        ElasticSolve solve(elements, kStone);
        constexpr double kPull = 1e6;
        pull_face(solve, half, 1, [](Vec3d) { return Vec3d{kPull, 0, 0}; });
        pull_face(solve, half, -1, [](Vec3d) { return Vec3d{-kPull, 0, 0}; });
        solve.solve();
        const double theory = 0.5 * kPull * kPull / kStone.young * solid.volume;
        EXPECT_NEAR(solve.energy() / theory, 1, 2e-3) << edge;
        EXPECT_LT(solve.pin_reaction(), 1e-9 * kPull * 0.01) << edge;
    }
}

TEST(SolidElements, ABentBarTakesTheEnergyAndStressOfTheory) {
    const Vec3d half{0.2, 0.05, 0.05};
    for (const int size : {2, 4}) {
        for (const double edge : {0.025, 0.05, 0.1}) {
            if (size == 4 && edge > 0.06) continue;
            const Solid solid = bar(half, edge, size);
            const SolidElements elements = make_elements(solid);
            ElasticSolve solve(elements, kStone);
            constexpr double kMost = 1e6;  // at y = half.y
            pull_face(solve, half, 1, [&](Vec3d p) { return Vec3d{kMost * p.y / half.y, 0, 0}; });
            pull_face(solve, half, -1, [&](Vec3d p) { return Vec3d{-kMost * p.y / half.y, 0, 0}; });
            solve.solve();
            const double theory = kMost * kMost / (6 * kStone.young) * solid.volume;
            double most = 0;
            for (const uint32_t c : solve.cells)
                if (std::fabs(solid.cells[c].centroid.x) < 0.1) most = std::max(most, solve.stress(c).first);
            EXPECT_GT(solve.energy() / theory, 0.95) << edge;
            EXPECT_LT(solve.energy() / theory, 1.02) << edge;
            EXPECT_NEAR(most / kMost, 1, edge > 0.04 ? 0.03 : 0.15) << edge;
        }
    }
}

// A plate that is much thinner than its elements bends as well.
TEST(SolidElements, AThinPlateBends) {
    const Vec3d half{0.2, 0.2, 0.01};
    for (const double edge : {0.02, 0.04, 0.05}) {
        const Solid solid = bar(half, edge, 2);
        const SolidElements elements = make_elements(solid);
        ElasticSolve solve(elements, kStone);
        constexpr double kMost = 1e6;
        pull_face(solve, half, 1, [&](Vec3d p) { return Vec3d{kMost * p.z / half.z, 0, 0}; });
        pull_face(solve, half, -1, [&](Vec3d p) { return Vec3d{-kMost * p.z / half.z, 0, 0}; });
        solve.solve();
        const double theory = kMost * kMost / (6 * kStone.young) * solid.volume;
        EXPECT_GT(solve.energy() / theory, 0.9) << edge;
    }
}

// Two legs, with a gap that is narrower than an element.
Mesh fork_mesh() {
    constexpr float w = 0.1f, h = 0.3f, b = 0.05f, l = 0.04f, depth = 0.05f;
    const Vec2 outline[8] = {{0, 0}, {w, 0}, {w, h}, {w - l, h}, {w - l, b}, {l, b}, {l, h}, {0, h}};
    Mesh mesh;
    for (const float z : {0.0f, depth})
        for (const Vec2& p : outline) mesh.positions.push_back({p.x, p.y, z});
    const uint32_t cap[6][3] = {{0, 1, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 7}, {1, 2, 3}, {1, 3, 4}};
    for (const auto& t : cap) {
        mesh.triangles.push_back({t[2], t[1], t[0]});
        mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
    }
    for (uint32_t i = 0; i < 8; ++i) {
        const uint32_t k = (i + 1) % 8;
        mesh.triangles.push_back({i, k, k + 8});
        mesh.triangles.push_back({i, k + 8, i + 8});
    }
    return mesh;
}

TEST(SolidElements, LegsThatPassThroughOneElementMoveApart) {
    double energy[2] = {};
    for (const uint32_t size : {2u, 4u}) {
        SolidSettings settings;
        settings.cells = size == 2 ? 6000 : 800;
        settings.element_edges = size;
        const Result<CookedSolid> cooked = cook_solid(fork_mesh(), settings);
        ASSERT_TRUE(cooked) << cooked.error();
        const Solid& solid = cooked->solid;
        const SolidElements elements = make_elements(solid);
        std::set<uint32_t> coarse;
        for (const CellMoments& row : solid.moments) coarse.insert(row.coarse);
        EXPECT_TRUE(size == 2 || elements.elements.size() > coarse.size());
        ElasticSolve solve(elements, kStone);
        double area = 0;
        for (const bool is_summed : {false, true})
            for (size_t i = 0; i < solid.patches.size(); ++i) {
                const SurfacePatch& patch = solid.patches[i];
                if (patch.centroid.y < 0.25) continue;
                if (!is_summed && patch.centroid.x < 0.05) area += patch.area;
                const Vec3d push{patch.centroid.x < 0.05 ? -1.0 : 1.0, 0, 0};
                if (is_summed) add_force(elements, elements.patches[i], 1000 * patch.area / area * push, solve.loads);
            }
        relieve(elements, solve.cells, 2000, mass_of(elements, solve.cells, 2000), {}, solve.loads);
        solve.solve();
        energy[size / 4] = solve.energy();
    }
    // Elements as tall as a third of the fork; glued legs would take 0.08 of it.
    EXPECT_GT(energy[1] / energy[0], 0.6);
    EXPECT_LT(energy[1] / energy[0], 1.05);
}

// A force on one end: what speeds the bar up takes it all, and the stress falls along the bar as its mass behind.
TEST(SolidElements, AFreeBarPushedAtOneEndHasTheStressOfItsMass) {
    const Vec3d half{0.2, 0.05, 0.05};
    const Solid solid = bar(half, 0.04, 2);
    const SolidElements elements = make_elements(solid);
    ElasticSolve solve(elements, kStone);
    constexpr double kPush = 1e6;
    pull_face(solve, half, -1, [](Vec3d) { return Vec3d{kPush, 0, 0}; });
    const PieceMass mass = mass_of(elements, solve.cells, 2000);
    EXPECT_NEAR(mass.mass, 2000 * solid.volume, 1e-9);
    relieve(elements, solve.cells, 2000, mass, {}, solve.loads);
    const TotalLoad left = total_of(elements, solve.loads, mass.centre);
    EXPECT_LT(length(left.force), 1e-9 * kPush * 0.01);
    EXPECT_LT(length(left.torque), 1e-9 * kPush * 0.01);
    solve.solve();
    EXPECT_LT(solve.pin_reaction(), 1e-9 * kPush * 0.01);
    double off = 0, count = 0;
    for (const uint32_t c : solve.cells) {
        const ElementPlace& probe = elements.probes[elements.first_probe[c]];
        const double stress = stress_at(solve.gradients[probe.element], probe.at, kStone).xx;
        off += std::fabs(stress + kPush * 0.5 * (1 - solid.cells[c].centroid.x / half.x)) / kPush, ++count;
    }
    EXPECT_LT(off / count, 0.02);
}

}  // namespace
}  // namespace cullet
