// The four ways of pushing the inner surface inward: what each of them promises (thick shell notes A3 to A5, T1 to T5).
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "tests/support/expect_always.hpp"
#include "tests/support/extrusions.hpp"
#include "tests/support/motion_contacts.hpp"
#include "tests/support/random_meshes.hpp"
#include "tests/support/shell_checks.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet {
namespace {

using test::kWays, test::prepared, test::random_thickness;

Extrusion extruded(const Surface& surface, double thickness, Propagation way) {
    ExtrusionSettings settings;
    settings.propagation = way;
    return test::extruded(surface, thickness, settings);
}

Mesh pleated() {
    return test::sheet_mesh(1, 1, 80, 8, [](double x, double) { return 0.1 * std::sin(30 * x); });
}

uint32_t inverted_elements(const Surface& surface, const Extrusion& shell) {
    uint32_t inverted = 0;
    for (const Triangle& c : surface.triangles) {
        std::array<Vec3d, 3> outer, inner;
        for (size_t k = 0; k < 3; ++k)
            outer[k] = surface.positions[c[k]], inner[k] = outer[k] + shell.depth[c[k]] * shell.direction[c[k]];
        const PrismTetrahedra tets = prism_tetrahedra(outer, inner, c);
        bool is_bad = false;
        for (size_t k = 0; k < 3; ++k) is_bad |= shell.depth[c[tets.flattens[k]]] > 0 && !(tets.volume[k] > 0);
        inverted += is_bad;
    }
    return inverted;
}

TEST(Propagation, TheGuardedFrontAndSingleVertexWithTetrahedraAreSoundForAnyShapeAndThickness) {
    test::expect_always(40, [](uint64_t seed) {
        const Surface surface = prepared(test::random_mesh(seed));
        const double thickness = random_thickness(surface, seed / 7);
        for (const Propagation way : {Propagation::GuardedFront, Propagation::SingleVertexTets}) {
            const Extrusion shell = extruded(surface, thickness, way);
            const test::ShellReport report = test::check_shell(surface, shell, thickness);
            RC_LOG() << report << '\n';
            RC_ASSERT(report.is_sound());
            RC_ASSERT(shell.statistics.inverted_elements + shell.statistics.crossings == 0u);
        }
    });
}

TEST(Propagation, SingleVertexLeavesNoFacesThatMeetForAnyShapeAndThickness) {
    test::expect_always(30, [](uint64_t seed) {
        const Surface surface = prepared(test::random_mesh(seed));
        const double thickness = random_thickness(surface, seed / 7);
        const Extrusion shell = extruded(surface, thickness, Propagation::SingleVertex);
        const test::ShellReport report = test::check_shell(surface, shell, thickness);
        RC_LOG() << report << '\n';
        RC_ASSERT(report.meeting + report.beyond_cap + report.unflagged == 0u);
        RC_ASSERT(shell.statistics.inverted_elements == inverted_elements(surface, shell));
    });
}

TEST(Propagation, WhatTheFrontLeavesIsCountedAsABruteForceCountsIt) {
    uint32_t left = 0, inverted = 0;
    test::expect_always(30, [&](uint64_t seed) {
        const Surface surface = prepared(test::random_mesh(seed));
        const double thickness = random_thickness(surface, seed / 7);
        const Extrusion shell = extruded(surface, thickness, Propagation::Front);
        RC_ASSERT(test::check_shell(surface, shell, thickness).beyond_cap == 0u);
        RC_ASSERT(shell.statistics.crossings == test::meetings_at(surface, shell.direction, shell.depth).size());
        RC_ASSERT(shell.statistics.inverted_elements == inverted_elements(surface, shell));
        left += shell.statistics.crossings, inverted += shell.statistics.inverted_elements;
    });
    EXPECT_GT(left, 0u);  // else nothing was compared
    EXPECT_GT(inverted, 0u);
}

TEST(Propagation, EveryWayGivesTheSameDepthsForAnyNumberingAndOnTwoThreads) {
    test::expect_always(15, [](uint64_t seed, uint64_t numbering) {
        const Mesh mesh = test::random_mesh(seed);
        const Surface surface = prepared(mesh), other = prepared(test::shuffled(mesh, numbering));
        RC_ASSERT(std::equal(surface.positions.begin(), surface.positions.end(), other.positions.begin(),
                             other.positions.end()));
        const double thickness = random_thickness(surface, seed / 7);
        for (const Propagation way : kWays) {
            const Extrusion alone = extruded(surface, thickness, way);
            Extrusion beside;
            std::thread second([&] { beside = extruded(other, thickness, way); });
            const Extrusion again = extruded(surface, thickness, way);
            second.join();
            RC_ASSERT(again.depth == alone.depth);
            RC_ASSERT(beside.depth == alone.depth);
            RC_ASSERT(beside.statistics.collisions == alone.statistics.collisions);
        }
    });
}

TEST(Propagation, OnAConvexBodyEveryWayReachesTheThicknessWithoutACollision) {
    for (const Mesh& mesh : {test::sphere_mesh(1, 3), test::box_mesh({1, 1, 1}, 6)})
        for (const Propagation way : kWays) {
            ExtrusionSettings settings;
            settings.propagation = way;
            settings.has_mitre = false;
            const Result<Extrusion> shell = extrude(prepared(mesh), 0.05, settings);
            ASSERT_TRUE(shell);
            EXPECT_EQ(shell->statistics.collisions, 0u);
            for (const double d : shell->depth) EXPECT_NEAR(d, 0.05, 1e-12) << mesh.name;
        }
}

TEST(Propagation, BetweenParallelWallsEveryWayGoesHalfWay) {
    const double gap = 0.1, step_min = gap / 2 / (64 * 5);
    const Surface surface = prepared(test::box_mesh({2, 2, gap}, 16));
    for (const Propagation way : kWays) {
        const Extrusion shell = extruded(surface, 0.4, way);
        size_t inside = 0;
        for (uint32_t v = 0; v < surface.positions.size(); ++v) {
            const Vec3d p = surface.positions[v];
            if (std::min({p.x, p.y, 2 - p.x, 2 - p.y}) < 0.3) continue;
            ++inside;
            EXPECT_NEAR(shell.depth[v], gap / 2, 0.02 * gap / 2 + step_min);
        }
        EXPECT_GT(inside, 100u);
    }
}

TEST(Propagation, OnAPleatedSheetTheFrontLeavesCrossingsAndBothPublishedWaysTurnElements) {
    const Surface surface = prepared(pleated());
    const double thickness = 0.1 * surface.diagonal;
    const ExtrusionStatistics front = extruded(surface, thickness, Propagation::Front).statistics;
    const ExtrusionStatistics single = extruded(surface, thickness, Propagation::SingleVertex).statistics;
    EXPECT_GT(front.crossings, 0u);
    EXPECT_GT(front.inverted_elements, 0u);
    EXPECT_GT(front.collisions, 0u);
    EXPECT_EQ(single.crossings, 0u);
    EXPECT_GT(single.inverted_elements, 0u);
    EXPECT_GT(single.collisions, 0u);
}

TEST(Propagation, AWayThatDoesNotExistIsRefused) {
    ExtrusionSettings settings;
    settings.propagation = static_cast<Propagation>(9);
    const Result<Extrusion> shell = extrude(prepared(test::sphere_mesh(1, 1)), 0.1, settings);
    ASSERT_FALSE(shell);
    EXPECT_NE(shell.error().find("propagation 9"), std::string::npos) << shell.error();
}

}  // namespace
}  // namespace cullet
