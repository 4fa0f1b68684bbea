// How deep a sheet is dented: metal shell note, section 6.
#include "systems/models/metal_shell/dent/sheet_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cullet {
namespace {

constexpr double kRadius = 0.145, kSupport = 0.4;  // m

TEST(SheetPlan, ABallOfAHundredKilogramsDentsAClampedPanelAsTheNoteSays) {
    struct Row {
        double speed, depth, contact, reach;
    };
    for (const Row& row : {Row{1, 8.8e-3, 26e-3, 0.10}, Row{2, 21.0e-3, 37e-3, 0.20}, Row{5, 55.9e-3, 55e-3, 0.40},
                           Row{10, 110e-3, 80e-3, 0.40}}) {
        const SheetPlan plan = plan_sheet({}, {kRadius, kSupport, 48 * row.speed * row.speed, 0});
        EXPECT_NEAR(plan.depth, row.depth, 0.01 * row.depth) << row.speed;
        EXPECT_NEAR(plan.contact, row.contact, 0.02 * row.contact) << row.speed;
        EXPECT_NEAR(plan.reach, row.reach, 0.02 * row.reach) << row.speed;
        EXPECT_FALSE(plan.is_puncture);
    }
}

TEST(SheetPlan, TheSameEnergyInPartsGivesTheSameDent) {
    const SheetPlan once = plan_sheet({}, {kRadius, kSupport, 1200, 0});
    double depth = 0;
    for (int part = 0; part < 10; ++part) depth = plan_sheet({}, {kRadius, kSupport, 120, depth}).depth;
    EXPECT_NEAR(depth, once.depth, 0.03 * once.depth);
}

TEST(SheetPlan, BelowItsElasticEnergyNothingStays) {
    const double elastic = elastic_energy({}, {kRadius, kSupport});
    EXPECT_GT(elastic, 1);
    EXPECT_LT(elastic, 10);
    EXPECT_FALSE(plan_sheet({}, {kRadius, kSupport, 0.99 * elastic, 0}).is_dent());
    EXPECT_TRUE(plan_sheet({}, {kRadius, kSupport, 1.01 * elastic, 0}).is_dent());
}

TEST(SheetPlan, TheSlopeEndsADentAndWhatIsLeftIsSaid) {
    const SheetPlan plan = plan_sheet({}, {kRadius, kSupport, 1e5, 0});
    EXPECT_TRUE(plan.is_puncture);
    EXPECT_GT(plan.left, 5e4);
    EXPECT_LT(plan.depth, 0.2);
    double depth = 0;
    for (int hit = 0; hit < 50; ++hit) depth = std::max(depth, plan_sheet({}, {kRadius, kSupport, 1200, depth}).depth);
    EXPECT_NEAR(depth, plan.depth, 0.01 * plan.depth);
}

TEST(SheetPlan, TheProfileFallsFromTheMiddleToNothingWithoutAStep) {
    const SheetPlan plan = plan_sheet({}, {kRadius, kSupport, 1200, 0});
    EXPECT_NEAR(profile(plan, kRadius, 0), plan.depth, 1e-12);
    double last = plan.depth;
    for (double away = 0; away < 2.2 * plan.reach; away += 1e-3) {
        const double now = profile(plan, kRadius, away);
        EXPECT_LE(now, last + 1e-12) << away;
        EXPECT_LT(last - now, 2e-3) << away;
        last = now;
    }
    EXPECT_EQ(profile(plan, kRadius, 2.01 * plan.reach), 0);
}

TEST(SheetPlan, AWidePanelBouncesALightBlowAndTakesAHardOne) {
    const double slow = plan_sheet({}, {kRadius, kSupport, 20, 0}).restitution,
                 fast = plan_sheet({}, {kRadius, kSupport, 5000, 0}).restitution;
    EXPECT_GT(slow, 0.5);
    EXPECT_LT(fast, 0.35);
}

TEST(SheetPlan, TheNotesBallDentsAClampedPanelAsOneThatIsHeldOtherwise) {
    for (const double energy : {48.0, 192.0, 1200.0, 4800.0}) {
        const double held = plan_sheet({}, {kRadius, kSupport, energy, 0, false}).depth;
        EXPECT_NEAR(plan_sheet({}, {kRadius, kSupport, energy, 0, true}).depth, held, 0.003 * held) << energy;
    }
}

// What springs back is the span's, be the contact wide or narrow: so a blunt ball dents deeper than it would by the
// note's term, a sharp one less.
TEST(SheetPlan, ABluntBallDentsAClampedPanelDeeperASharpOneLess) {
    const auto share = [](double radius, double thickness) {
        SheetMetal metal;
        metal.thickness = thickness;
        const double energy = 260e3 * thickness;
        return plan_sheet(metal, {radius, kSupport, energy, 0, true}).depth /
               plan_sheet(metal, {radius, kSupport, energy, 0, false}).depth;
    };
    double last = share(0.03, 1e-3);
    EXPECT_LT(last, 0.98);
    for (double radius = 0.03; radius < 2; radius *= 1.05) {
        EXPECT_GE(share(radius, 1e-3), last - 1e-6) << radius;
        last = share(radius, 1e-3);
    }
    EXPECT_GT(last, 1.1);
    // Bending keeps more of a thick sheet's dome.
    for (const double thickness : {1e-3, 1.5e-3, 2e-3, 3e-3})
        EXPECT_GT(share(0.3, thickness + 0.5e-3), share(0.3, thickness)) << thickness;
}

}  // namespace
}  // namespace cullet
