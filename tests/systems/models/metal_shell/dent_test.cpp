// The dent of a ball in a clamped panel: metal shell note, section 15.
#include "systems/models/metal_shell/dent/dent.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sample_game/meshes.hpp"
#include "systems/models/metal_shell/dent/limit_stretch.hpp"
#include "systems/models/metal_shell/dent/raise_sheet.hpp"
#include "tests/systems/models/metal_shell/panels.hpp"

namespace cullet {
namespace {

constexpr double kWidth = 1.2, kHeight = 0.8;

const Model& panel() {
    static const Model model = test::cook_metal(metal_sheet(kWidth, kHeight, 72, 48));
    return model;
}

Striker ball_at(double x, double y, double z = 0) {
    Striker ball;
    ball.shape = StrikerShape::Sphere;
    ball.point = {x, y, z}, ball.push = {0, 0, -1};
    ball.radius = 0.145;
    return ball;
}

double lowest(const MetalView& metal) {
    double low = 0;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        low = std::min(low, double{metal.vertices().place[metal.vertex(v)].z});
    return low;
}

TEST(Dent, ItIsAsDeepAsPlannedWhateverTheSubShells) {
    const test::MetalSheet like(panel());
    const SheetPlan plan = plan_sheet(sheet_metal(like.view()), {0.145, 0.4, 1200, 0});
    for (const uint32_t cells : {32u, 128u, 512u}) {
        test::MetalSheet sheet(panel(), cells);
        sheet.clamp(kWidth, kHeight);
        const Dent dent = work_dent(sheet.view(), ball_at(0, 0), 1200);
        ASSERT_EQ(dent.kind, DentKind::Sheet);
        EXPECT_NEAR(-lowest(sheet.view()), plan.depth, 0.03 * plan.depth) << cells;
        const StretchCount stretch = count_stretch(sheet.view(), 0.25, 0.4);
        EXPECT_EQ(stretch.outside, 0u) << cells << ": " << stretch.shortest << " to " << stretch.longest;
    }
}

TEST(Dent, EnergyInPartsAndInOneGoDigsTheSame) {
    test::MetalSheet once(panel()), parts(panel());
    once.clamp(kWidth, kHeight), parts.clamp(kWidth, kHeight);
    work_dent(once.view(), ball_at(0, 0), 1200);
    const double deep = -lowest(once.view());
    double z = 0;
    for (int part = 0; part < 10; ++part) {
        work_dent(parts.view(), ball_at(0, 0, z), 120);
        bake_dent(parts.view());
        z = lowest(parts.view());
    }
    EXPECT_NEAR(-z, deep, 0.05 * deep);
}

TEST(Dent, NothingMovesBeyondItsReachNorAtPins) {
    test::MetalSheet sheet(panel());
    sheet.clamp(kWidth, kHeight);
    work_dent(sheet.view(), ball_at(0.1, 0, 0), 66);
    const MetalView metal = sheet.view();
    uint32_t moved = 0;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const Vec3 start = metal.vertices().start[metal.vertex(v)], place = metal.vertices().place[metal.vertex(v)];
        if (place == start) continue;
        ++moved;
        EXPECT_FALSE(metal.is_pinned(v));
        const double away = std::hypot(double{start.x} - 0.1, double{start.y});
        const float sag_at_most = away > 0.5 ? 1e-3f : 1;
        EXPECT_LT(length(place - start), sag_at_most) << "of the whole sheet";
        EXPECT_LT(away, 0.8) << "twice as far as what holds it";
    }
    EXPECT_GT(moved, 100u);
}

TEST(Dent, FiftyHitsTurnNoTriangleAndStretchNoEdgePastItsLimit) {
    test::MetalSheet sheet(panel());
    sheet.clamp(kWidth, kHeight);
    const MetalView metal = sheet.view();
    uint64_t seed = 7;
    const auto next = [&seed] {
        seed = seed * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<double>(seed >> 11) / 9007199254740992.0;
    };
    for (int hit = 0; hit < 50; ++hit) {
        const double x = (next() - 0.5) * 0.8, y = (next() - 0.5) * 0.5;
        double z = -1;  // where the ball meets the sheet first: over the highest point below it
        for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
            const Vec3 p = sheet.rows->vertices.rest[metal.shell.vertex(v)];
            const double away = std::hypot(double{p.x} - x, double{p.y} - y);
            if (away < 0.145) z = std::max(z, double{p.z} - 0.145 + std::sqrt(0.145 * 0.145 - away * away));
        }
        work_dent(metal, ball_at(x, y, z), 1200);
        bake_dent(metal);
    }
    const StretchCount stretch = count_stretch(metal, 0.25, 0.4);
    EXPECT_EQ(stretch.outside, 0u) << stretch.shortest << " to " << stretch.longest;
    EXPECT_NEAR(-lowest(metal), 0.092, 0.02);
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        const auto& c = metal.corners(e);
        const auto& rest = sheet.rows->vertices.rest;
        const Vec3 p = rest[metal.shell.vertex(c[0])];
        EXPECT_GT(cross(rest[metal.shell.vertex(c[1])] - p, rest[metal.shell.vertex(c[2])] - p).z, 0) << e;
    }
}

TEST(Dent, AMirroredHitRaisesAMirroredField) {
    test::MetalSheet left(panel()), right(panel());
    left.clamp(kWidth, kHeight), right.clamp(kWidth, kHeight);
    work_dent(left.view(), ball_at(-0.15, 0.05), 600);
    work_dent(right.view(), ball_at(0.15, 0.05), 600);
    std::map<std::pair<int, int>, float> fields;
    const auto key = [](double x, double y) {
        return std::pair(static_cast<int>(std::lround(x * 1e4)), static_cast<int>(std::lround(y * 1e4)));
    };
    const MetalView a = left.view(), b = right.view();
    for (uint32_t v = 0; v < a.vertex_count(); ++v) {
        const Vec3 p = a.vertices().original[a.vertex(v)];
        fields[key(-double{p.x}, double{p.y})] = a.vertices().field[a.vertex(v)];
    }
    for (uint32_t v = 0; v < b.vertex_count(); ++v) {
        const Vec3 p = b.vertices().original[b.vertex(v)];
        EXPECT_NEAR(b.vertices().field[b.vertex(v)], (fields[key(double{p.x}, double{p.y})]), 1e-3)
            << p.x << " " << p.y;
    }
}

TEST(Dent, WhatAnEarlierImpactLeftBesideTheShapeDoesNotCount) {
    test::MetalSheet clear(panel()), used(panel());
    clear.clamp(kWidth, kHeight), used.clamp(kWidth, kHeight);
    const MetalView a = clear.view(), b = used.view();
    for (uint32_t c = 0; c < b.cell_count(); ++c)
        b.cells().fold[b.cell(c)] = b.cells().crease[b.cell(c)] = b.cells().field[b.cell(c)] = 0.3f;
    work_dent(a, ball_at(0, 0), 600);
    work_dent(b, ball_at(0, 0), 600);
    for (uint32_t v = 0; v < a.vertex_count(); ++v)
        ASSERT_TRUE(a.vertices().place[a.vertex(v)] == b.vertices().place[b.vertex(v)]) << v;
}

TEST(Dent, ABoxThatFallsOnItsCornerLosesTheCornerAndKeepsTheRest) {
    test::MetalSheet sheet(test::cook_metal(test::box_mesh({0.3, 0.3, 0.3}, 12)));
    const MetalView metal = sheet.view();
    ASSERT_GT(metal.shells().crush_pressure[metal.row], 0);
    Striker floor;
    floor.push = normalised(Vec3d(1, 1, 1));
    floor.point = {};
    const Dent dent = work_dent(metal, floor, 60);
    ASSERT_EQ(dent.kind, DentKind::Body);
    EXPECT_GT(dent.depth, 0.01);
    EXPECT_LT(dent.depth, 0.16);
    uint32_t still = 0;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const Vec3d place(metal.vertices().place[metal.vertex(v)]), start(metal.vertices().start[metal.vertex(v)]);
        EXPECT_GE(dot(place - floor.point, floor.push), dent.depth - 2e-3);
        still += place == start;
    }
    EXPECT_GT(still, metal.vertex_count() / 2);
}

/// A drum of 5,000 vertices that fell on its rim.
test::MetalSheet crushed_drum() {
    test::MetalSheet sheet(test::cook_metal(make_drum()));
    const MetalView metal = sheet.view();
    Striker floor;
    floor.push = normalised(Vec3d(0.6, 0.8, 0));
    double least = 1e30;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        least = std::min(least, floor.gap(Vec3d(metal.vertices().original[metal.vertex(v)])));
    floor.point = least * floor.push;
    const Dent dent = work_dent(metal, floor, 800);
    EXPECT_EQ(dent.kind, DentKind::Body);
    EXPECT_GT(dent.depth, 0.05);
    return sheet;
}

TEST(Dent, AlongTheEndOfACrushNothingStandsOffFromWhatStays) {
    const test::MetalSheet sheet = crushed_drum();
    const MetalView metal = sheet.view();
    const MetalVertices& v = metal.vertices();
    uint32_t ends = 0;
    for (uint32_t a = 0; a < metal.vertex_count(); ++a)
        metal.for_each_spring(a, [&](uint32_t b, uint32_t spring) {
            const uint32_t p = metal.vertex(a), q = metal.vertex(b);
            if (!(v.field[p] > 0) || v.field[q] > 0) return;
            ++ends;
            EXPECT_LT(length(v.place[p] - v.start[p]), 0.3f * metal.springs().length[spring]) << a << " " << b;
        });
    EXPECT_GT(ends, 20u);
}

TEST(Dent, WhatWasDrawnAsOneSurfaceIsWhereItIsNotFoldedSharply) {
    test::MetalSheet sheet = crushed_drum();
    const MetalView metal = sheet.view();
    const auto& normals = sheet.rows->elements.normal;
    const auto normal_at = [&](uint32_t e, uint32_t v) {
        const auto& c = metal.corners(e);
        const size_t k = 3 * static_cast<size_t>(std::find(c.begin(), c.end(), v) - c.begin());
        const auto& all = normals[metal.shell.element(e)];
        return Vec3{all[k], all[k + 1], all[k + 2]};
    };
    const auto for_each_pair = [&](auto visit) {
        for (uint32_t e = 0; e < metal.element_count(); ++e)
            for (uint32_t k = 0; k < 3; ++k) {
                const uint32_t beside = sheet.rows->elements.neighbour[metal.shell.element(e)][k];
                if (beside == kNone || beside < e) continue;
                for (const uint32_t v : {metal.corners(e)[k], metal.corners(e)[(k + 1) % 3]})
                    visit(normal_at(e, v), normal_at(beside, v));
            }
    };
    uint32_t alike_before = 0, alike = 0;
    for_each_pair([&](Vec3 a, Vec3 b) { alike_before += dot(a, b) > 0.9999f; });
    ASSERT_TRUE(bake_dent(metal));
    for_each_pair([&](Vec3 a, Vec3 b) {
        alike += dot(a, b) > 0.9999f;
        EXPECT_NEAR(length(a), 1, 1e-3);
    });
    EXPECT_GT(alike_before, 1000u);
    EXPECT_GT(alike, 0.97 * alike_before);
}

}  // namespace
}  // namespace cullet
