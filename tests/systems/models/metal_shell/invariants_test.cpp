// What is true of every dent (metal shell note, section 15).
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sample_game/meshes.hpp"
#include "sample_game/metal/metal_bench.hpp"
#include "systems/models/metal_shell/dent/raise_body.hpp"
#include "systems/models/metal_shell/dent/raise_sheet.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet {
namespace {

const Model& panel(uint32_t columns = 72) {
    static std::map<uint32_t, Model> made;
    const auto known = made.find(columns);
    if (known != made.end()) return known->second;
    return made
        .emplace(columns, cook_metal_mesh(metal_sheet(1.2, 0.8, columns, 2 * columns / 3), "steel", 1e-3).value())
        .first->second;
}
MetalBench bench_of(uint32_t columns, uint32_t cells) {
    MetalCookSettings settings;
    settings.cells.count = cells;
    MetalBench bench(panel(columns), &settings);
    bench.clamp();
    return bench;
}
MetalBench box_bench(uint32_t cells = 0) {
    static const Model kBox = cook_metal_mesh(test::box_mesh({0.6, 0.6, 0.6}, 16), "steel", 1e-3).value();
    MetalCookSettings settings;
    settings.cells.count = cells;
    return MetalBench(kBox, &settings);
}
Striker flat(Vec3d point, Vec3d push) {
    Striker striker;
    striker.point = point, striker.push = normalised(push);
    return striker;
}

// I1.
TEST(MetalInvariants, EveryTriangleIsInOneSubShellAndBordersAreTheSameFromBothSides) {
    MetalBench box = box_bench(40);
    const MetalView metal = box.view();
    ASSERT_EQ(metal.cell_count(), 40u);
    uint32_t counted = 0;
    for (uint32_t c = 0; c < metal.cell_count(); ++c) {
        counted += metal.cells().element_count[metal.cell(c)];
        EXPECT_EQ(metal.cell_of(metal.cells().representative[metal.cell(c)]), c);
        metal.for_each_border(c, [&](uint32_t other, float length) {
            float back = 0;
            metal.for_each_border(other, [&](uint32_t own, float from_there) {
                if (own == c) back = from_there;
            });
            EXPECT_EQ(back, length) << c << " " << other;
        });
    }
    EXPECT_EQ(counted, metal.element_count());
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        float sum = 0;
        for (uint32_t k = 0; k < kBlended; ++k) sum += metal.vertices().weight[metal.vertex(v)][k];
        EXPECT_NEAR(sum, 1, 1e-5) << v;
    }
}

// I4.
TEST(MetalInvariants, WhatIsNotStruckHardDoesNotMoveByABit) {
    MetalBench sheet = bench_of(72, 64);
    EXPECT_EQ(sheet.hit(sheet.ball_over(0, 0, 0.145), 1).kind, DentKind::None);
    MetalBench box = box_bench();
    EXPECT_EQ(box.hit(flat({}, {1, 1, 1}), 0).kind, DentKind::None);
    for (const MetalBench* bench : {&sheet, &box})
        for (uint32_t v = 0; v < bench->view().vertex_count(); ++v) ASSERT_TRUE(bench->place(v) == bench->original(v));
}

// I5 after one crash on an even mesh.
TEST(MetalInvariants, EdgesKeepToTheirLimits) {
    MetalBench box = box_bench();
    box.hit(flat({}, {1, 1, 1}), 400);
    const StretchCount stretch = box.stretch(0.25, 0.4);
    EXPECT_LE(stretch.outside, 0.01 * stretch.edges) << stretch.shortest << " to " << stretch.longest;
}

// I6.
TEST(MetalInvariants, WhatStaysInTheMetalIsLessThanWhatStruck) {
    for (const double energy : {10.0, 60.0, 300.0, 1200.0, 20000.0, 1e6}) {
        MetalBench sheet = bench_of(72, 64);
        const Dent dent = sheet.hit(sheet.ball_over(0, 0, 0.145), energy);
        EXPECT_LE(dent.plastic, energy);
        EXPECT_LE(dent.left, energy);
        EXPECT_LE(dent.plastic + dent.left, energy * (1 + 1e-12)) << energy;
        EXPECT_EQ(dent.plastic > 0, dent.kind != DentKind::None) << energy;
        MetalBench box = box_bench();
        const Dent crush = box.hit(flat({}, {1, 1, 1}), energy);
        EXPECT_LE(crush.plastic + crush.left, energy * (1 + 1e-12)) << energy;
    }
}

// I8: fans of one place were split where they met in one point.
TEST(MetalInvariants, WhatStoodAtOnePlaceStaysTogether) {
    // Two sheets that share one point alone.
    Mesh mesh = metal_sheet(0.5, 0.5, 16, 16);
    test::append(mesh, metal_sheet(0.5, 0.5, 16, 16), {0.5, 0.5, 0});
    const Model model = cook_metal_mesh(mesh, "steel", 1e-3).value();
    MetalBench bench(model);
    bench.hit(bench.ball_over(0.1, 0.1, 0.145), 300);
    const MetalView metal = bench.view();
    std::map<std::array<float, 3>, uint32_t> first;
    uint32_t doubled = 0;
    double apart = 0;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const Vec3 p = bench.original(v);
        const auto [at, is_new] = first.try_emplace({p.x, p.y, p.z}, v);
        if (is_new) continue;
        ++doubled;
        apart = std::max(apart, double{length(bench.place(v) - bench.place(at->second))});
    }
    EXPECT_GT(doubled, 0u);
    EXPECT_LT(apart, 1e-6);
}

// I10: 40 degrees about an axis of no mesh's own.
TEST(MetalInvariants, ATurnedSceneGivesTheTurnedDent) {
    const Vec3d axis = normalised(Vec3d(1, 2, 3));
    double sine = 0, cosine = 1;
    sine_cosine(0.7, sine, cosine);
    const auto turn = [&](Vec3d p) {
        return cosine * p + sine * cross(axis, p) + ((1 - cosine) * dot(axis, p)) * axis;
    };
    Mesh mesh = metal_sheet(1.2, 0.8, 48, 32), turned = mesh;
    for (Vec3& p : turned.positions) p = turn(Vec3d(p)).to_float();
    const Model one = cook_metal_mesh(mesh, "steel", 1e-3).value(),
                other = cook_metal_mesh(turned, "steel", 1e-3).value();
    MetalBench a(one), b(other);
    const auto is_border = [](Vec3d p) { return std::fabs(p.x) > 0.599 || std::fabs(p.y) > 0.399; };
    const auto back = [&](Vec3 p) {
        const Vec3d q(p);
        return cosine * q - sine * cross(axis, q) + ((1 - cosine) * dot(axis, q)) * axis;
    };
    a.hold([&](Vec3 p) { return is_border(Vec3d(p)); });
    b.hold([&](Vec3 p) { return is_border(back(p)); });
    Striker ball = a.ball_over(0.07, 0.03, 0.145);
    a.hit(ball, 800);
    ball.point = turn(ball.point), ball.push = turn(ball.push);
    b.hit(ball, 800);
    // The field is that of the shape alone; creases follow sub-shells, which the order of vertices decides.
    std::map<std::pair<int, int>, double> fields;
    const auto key = [](Vec3d p) {
        return std::pair(static_cast<int>(std::lround(p.x * 1e3)), static_cast<int>(std::lround(p.y * 1e3)));
    };
    for (uint32_t v = 0; v < a.view().vertex_count(); ++v)
        fields[key(Vec3d(a.original(v)))] = double{a.view().vertices().field[a.view().vertex(v)]};
    for (uint32_t v = 0; v < b.view().vertex_count(); ++v)
        EXPECT_NEAR(double{b.view().vertices().field[b.view().vertex(v)]}, fields[key(back(b.original(v)))], 1e-4) << v;
}

// I11.
TEST(MetalInvariants, DepthDoesNotHangOnTheMeshNorOnTheSubShells) {
    double least = 1e30, most = 0;
    for (const auto& [columns, cells] : {std::pair{36u, 32u}, {72u, 32u}, {72u, 128u}, {72u, 512u}, {144u, 128u}}) {
        MetalBench bench = bench_of(columns, cells);
        const Dent dent = bench.hit(bench.ball_over(0, 0, 0.145), 1200);
        least = std::min(least, dent.depth), most = std::max(most, dent.depth);
    }
    EXPECT_LT(most / least, 1.01);
    least = 1e30, most = 0;
    for (const uint32_t cells : {16u, 64u, 256u}) {
        MetalBench box = box_bench(cells);
        const Dent dent = box.hit(flat({}, {1, 1, 1}), 400);
        least = std::min(least, dent.depth), most = std::max(most, dent.depth);
    }
    EXPECT_LT(most / least, 1.01);
}

// I12.
TEST(MetalInvariants, AFieldGoesTheWayOfThePushAndNothingIsLeftInTheStriker) {
    MetalBench sheet = bench_of(72, 128);
    const Striker ball = sheet.ball_over(0.1, 0.05, 0.145);
    const Dent dent = sheet.hit(ball, 1200);
    MetalBench box = box_bench();
    const Striker floor = flat({}, {1, 1, 1});
    const Dent crush = box.hit(floor, 400);
    for (const auto& [bench, striker, depth] : {std::tuple{&sheet, &ball, dent.depth}, {&box, &floor, crush.depth}})
        for (uint32_t v = 0; v < bench->view().vertex_count(); ++v) {
            EXPECT_GE(bench->view().vertices().field[bench->view().vertex(v)], 0);
            EXPECT_LT(striker->covers(Vec3d(bench->place(v)), depth), 1e-4) << v;
        }
}

/// How far any vertex is out of the box of the original shape, m.
double out_of_box(const MetalBench& bench) {
    Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
    float out = 0;
    for (uint32_t v = 0; v < bench.view().vertex_count(); ++v) {
        const Vec3 p = bench.original(v);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    for (uint32_t v = 0; v < bench.view().vertex_count(); ++v) {
        const Vec3 p = bench.place(v);
        out = std::max({out, low.x - p.x, low.y - p.y, low.z - p.z, p.x - high.x, p.y - high.y, p.z - high.z});
    }
    return double{out};
}

// A spike metres long stood out of a drum: edges between what moved and what did not were drawn past their limits, by
// more each round.
TEST(MetalInvariants, ObliqueHitsLeaveABodyAboutItsBox) {
    const Model drum = cook_metal_mesh(make_drum(0.88f, 3500), "aluminium", 1e-3).value(),
                box = cook_metal_mesh(test::box_mesh({0.9, 0.5, 0.7}, 20), "aluminium", 1e-3).value(),
                sheet = cook_metal_mesh(metal_sheet(1.2, 0.8, 48, 32), "aluminium", 1e-3).value();
    const std::pair<const char*, const Model*> bodies[] = {{"drum", &drum}, {"box", &box}, {"panel", &sheet}};
    for (const auto& [name, model] : bodies)
        for (const double tilt : {0.0, 20.0, 40.0, 60.0, 80.0}) {
            uint64_t seed = 3;
            const auto next = [&seed] {
                seed = seed * 6364136223846793005ull + 1442695040888963407ull;
                return static_cast<double>(seed >> 11) / 9007199254740992.0;
            };
            MetalBench bench(*model);
            if (model == &sheet) bench.clamp();
            const MetalView metal = bench.view();
            double worst = 0;
            for (int hit = 0; hit < 60; ++hit) {
                const auto e = static_cast<uint32_t>(next() * metal.element_count());
                const auto& c = metal.corners(e);
                const Vec3d p(bench.original(c[0])), q(bench.original(c[1])), r(bench.original(c[2]));
                const Vec3d normal = normalised(cross(q - p, r - p)), along = normalised(q - p);
                double sine, cosine, x, y;
                sine_cosine(tilt * 3.14159265 / 180, sine, cosine);
                sine_cosine(6.2831853 * next(), y, x);
                Striker ball;
                ball.shape = StrikerShape::Sphere, ball.radius = 0.1;
                ball.point = Vec3d(bench.place(c[0]));
                ball.push = normalised(sine * (x * along + y * cross(normal, along)) - cosine * normal);
                bench.hit(ball, 600);
                worst = std::max(worst, out_of_box(bench));
            }
            EXPECT_LT(worst, 0.25) << name << ", " << tilt << " degrees";
        }
}

TEST(MetalInvariants, APoleIsAFrontAsWellAsAFormula) {
    // A round post on a grid of heights beside the cylinder in closed form.
    std::vector<std::array<float, kFrontRows>> rows(kFrontRows);
    Striker front, pole;
    pole.shape = StrikerShape::Cylinder, front.shape = StrikerShape::Front;
    pole.push = front.push = {0, 0, -1};
    pole.axis = {0, 1, 0}, pole.radius = 0.15;
    front.front.rows = rows.data();
    front.front.v = {0, 1, 0}, front.front.u = cross(front.front.v, front.push);
    front.front.low_u = -0.15, front.front.step_u = 0.3 / kFrontRows;
    front.front.low_v = -2, front.front.step_v = 4.0 / kFrontRows;
    front.front.half_u = 0.15;
    for (auto& row : rows)
        for (uint32_t i = 0; i < kFrontRows; ++i) {
            const double u = front.front.low_u + (i + 0.5) * front.front.step_u;
            row[i] = static_cast<float>(std::sqrt(0.0225 - u * u) - 0.15);
        }
    for (const double by : {0.0, 0.2}) {
        const Striker a = front.widened(by), b = pole.widened(by);
        for (double x = -0.4; x < 0.4; x += 0.0137) {
            const Vec3d place(x, 0.3, -0.05);
            if (std::fabs(x) > 0.93 * b.radius && std::fabs(x) < 1.01 * b.radius) continue;  // the silhouette
            EXPECT_EQ(a.gap(place) > 1e20, b.gap(place) > 1e20) << x << " " << by;
            if (b.gap(place) > 1e20) continue;
            EXPECT_NEAR(a.gap(place), b.gap(place), 2e-3 * (1 + by / 0.15)) << x << " " << by;
        }
    }
}

}  // namespace
}  // namespace cullet
