// The published column of the method, switch by switch.
#include <gtest/gtest.h>

#include <cmath>

#include "sample_game/metal/metal_bench.hpp"
#include "systems/models/metal_shell/published/hit_cells.hpp"
#include "systems/models/metal_shell/published/penalty.hpp"
#include "systems/models/metal_shell/published/pull_edges.hpp"

namespace cullet {
namespace {

const Model& panel() {
    static const Model model = cook_metal_mesh(metal_sheet(1.2, 0.8, 48, 32), "steel", 1e-3).value();
    return model;
}
MetalBench bench_of(uint8_t published, uint32_t cells = 64) {
    MetalCookSettings settings;
    settings.cells.count = cells, settings.published = published;
    MetalBench bench(panel(), &settings);
    bench.clamp();
    return bench;
}

bool is_same(const MetalBench& a, const MetalBench& b) {
    for (uint32_t v = 0; v < a.view().vertex_count(); ++v)
        if (!(a.place(v) == b.place(v))) return false;
    return true;
}

TEST(Published, SpringsComeToRestInTheirDepthAndGiveBackTheRootOfTheRatio) {
    for (const double e : {0.1, 0.2, 0.5, 1.0}) {
        PenaltyContact contact;
        contact.mass = 3, contact.speed = 4, contact.depth = 0.002, contact.recede = e * e;
        const PenaltyOutcome out = press(contact);
        EXPECT_NEAR(out.rebound, 4 * e, 0.03 * 4 * e) << e;
        EXPECT_NEAR(out.deepest, 0.002, 1e-4) << e;
        EXPECT_NEAR(out.impulse, 3 * 4 * (1 + e), 0.02 * 12 * (1 + e)) << e;
    }
}

TEST(Published, FewPlainStepsBounceHigher) {
    PenaltyContact contact;
    contact.splits_turn = false, contact.steps = 10;
    const double coarse = press(contact).rebound;
    contact.steps = 200;
    EXPECT_GT(coarse, 0.23);
    EXPECT_NEAR(press(contact).rebound, 0.2, 0.002);
}

TEST(Published, PullingEdgesKeepTheMiddleOfMassWhereNothingIsHeld) {
    MetalBench bench(panel());
    bench.hit(bench.ball_over(0.1, 0.05, 0.145), 1e-9);
    const MetalView metal = bench.view();
    sum_areas(metal);
    for (uint32_t v = 0; v < metal.vertex_count(); v += 7) {
        const uint32_t row = metal.vertex(v);
        metal.vertices().place.set(row, metal.vertices().place[row] + Vec3{0.01f, -0.004f, -0.02f});
    }
    const auto moment = [&] {
        Vec3d sum;
        double whole = 0;
        for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
            const double mass = double{metal.vertices().area[metal.vertex(v)]};
            sum += mass *
                   (Vec3d(metal.vertices().place[metal.vertex(v)]) - Vec3d(metal.vertices().start[metal.vertex(v)]));
            whole += mass * length(Vec3d(metal.vertices().place[metal.vertex(v)]) -
                                   Vec3d(metal.vertices().start[metal.vertex(v)]));
        }
        return std::pair(sum, whole);
    };
    const auto [before, whole] = moment();
    for (int round = 0; round < 10; ++round) pull_edges(metal, 1);
    EXPECT_LT(length(moment().first - before), 1e-6 * whole);
}

TEST(Published, NothingPullsWhereNothingMoved) {
    MetalBench bench(panel());
    bench.hit(bench.ball_over(0, 0, 0.145), 1e-9);
    const MetalView metal = bench.view();
    sum_areas(metal);
    for (int round = 0; round < 10; ++round) pull_edges(metal, 0.1), cut_long_edges(metal, 0.25);
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        ASSERT_TRUE(metal.vertices().place[metal.vertex(v)] == metal.vertices().start[metal.vertex(v)]);
}

TEST(Published, ASwitchThatHasNothingToSayLeavesEveryBit) {
    MetalBench ours = bench_of(0);
    ours.hit(ours.ball_over(0.1, 0, 0.145), 600);
    for (const PublishedChoice choice : {kPublishedContact, kPublishedDepth}) {
        MetalBench other = bench_of(choice);
        other.hit(other.ball_over(0.1, 0, 0.145), 600);
        EXPECT_TRUE(is_same(ours, other)) << int{choice};
    }
}

TEST(Published, EveryOtherSwitchMakesAnotherDentOfTheSameSheet) {
    MetalBench ours = bench_of(0);
    const Dent dent = ours.hit(ours.ball_over(0.1, 0, 0.145), 600);
    for (const int bits :
         {+kPublishedShape, +kPublishedCells, +kPublishedBorders, +kPublishedSprings, +kAllPublished}) {
        const auto choice = static_cast<uint8_t>(bits);
        MetalBench other = bench_of(choice);
        const Dent own = other.hit(other.ball_over(0.1, 0, 0.145), 600);
        EXPECT_FALSE(is_same(ours, other)) << int{choice};
        EXPECT_TRUE(other.is_finite()) << int{choice};
        EXPECT_EQ(own.depth, dent.depth) << int{choice};
        EXPECT_NEAR(-other.lowest(), dent.depth, 0.5 * dent.depth) << int{choice};
        for (uint32_t v = 0; v < other.view().vertex_count(); ++v) {
            if (!other.view().is_pinned(v)) continue;
            ASSERT_TRUE(other.place(v) == other.original(v)) << int{choice};
        }
    }
}

TEST(Published, AHitSubShellMovesAsOnePieceAndTheOthersStay) {
    MetalBench bench = bench_of(kPublishedShape | kPublishedBorders | kPublishedCells, 16);
    const MetalView metal = bench.view();
    bench.hit(bench.ball_over(0.1, 0, 0.145), 1e-9);
    CellBlow blow;
    blow.depth = 0.03;
    move_hit_cells(metal, bench.ball_over(0.1, 0, 0.145), blow);
    uint32_t hit = kNone, touched = 0;
    for (uint32_t c = 0; c < metal.cell_count(); ++c)
        if (metal.cells().is_touched[metal.cell(c)]) hit = c, ++touched;
    ASSERT_EQ(touched, 1u);
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        const auto& c = metal.corners(e);
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t v = metal.vertex(c[k]), w = metal.vertex(c[(k + 1) % 3]);
            const double before = length(Vec3d(metal.vertices().start[v]) - Vec3d(metal.vertices().start[w])),
                         after = length(Vec3d(metal.vertices().place[v]) - Vec3d(metal.vertices().place[w]));
            if (metal.cell_of(e) != hit) continue;
            ASSERT_NEAR(after, before, 1e-6);
        }
    }
    uint32_t moved = 0;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        moved += !(metal.vertices().place[metal.vertex(v)] == metal.vertices().start[metal.vertex(v)]);
    EXPECT_LT(moved, metal.vertex_count() / 6);
}

TEST(Published, ATimeOfItsOwnMovesByTheImpulse) {
    MetalCookSettings settings;
    settings.cells.count = 16,
    settings.published = kPublishedShape | kPublishedDepth | kPublishedBorders | kPublishedCells;
    settings.impulse_time = 1e-4f;
    MetalBench bench(panel(), &settings);
    Striker ball = bench.ball_over(0.1, 0, 0.145);
    ball.impulse = 2;
    bench.hit(ball, 600);
    const MetalView metal = bench.view();
    for (uint32_t c = 0; c < metal.cell_count(); ++c) {
        if (!metal.cells().is_touched[metal.cell(c)] || !(length(metal.cells().moved[metal.cell(c)]) > 0)) continue;
        EXPECT_NEAR(double{length(metal.cells().moved[metal.cell(c)])}, 1e-4 * 2 / mass_of_cell(metal, c).mass, 1e-6);
    }
}

}  // namespace
}  // namespace cullet
