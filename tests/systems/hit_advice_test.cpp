// The advice that cooking gives is followed: the model that it asks for fits the budget.
#include "systems/cook/hit_advice.hpp"

#include <gtest/gtest.h>

#include "cullet/model.hpp"
#include "systems/cook/model_contents.hpp"
#include "tests/support/large_hits.hpp"

namespace cullet {
namespace {

Model vase(float edge, float longest_edge = 100) {
    CookSettings settings;
    settings.thickness = 0.005f;
    settings.longest_edge = longest_edge;
    return test::cook_vase(0.30f, edge, settings).value();
}
double mean_edge(const Model& model) {
    return model.contents->state.shells.mean_edge[model.contents->shell];
}

TEST(HitAdvice, AVaseWithTheEdgesThatAreAskedForFitsTheBudget) {
    const Model fine = vase(0.0045f);
    const uint64_t units = fine.report().units_of_a_hit;
    ASSERT_GT(units, 2 * kDefaultHoldUnits);
    EXPECT_NE(fine.report().advice.find("would fit"), std::string::npos) << fine.report().advice;
    const double asked = edge_for_units(mean_edge(fine), units, kDefaultHoldUnits);
    // The lathe makes edges in proportion to what it is told.
    const Model coarse = vase(static_cast<float>(0.0045 * asked / mean_edge(fine)));
    EXPECT_NEAR(mean_edge(coarse) / asked, 1, 0.05);
    // Between the third power, which is asked by, and the fourth, where hinges limit the step.
    const double ratio = asked / mean_edge(fine),
                 share = static_cast<double>(coarse.report().units_of_a_hit) / static_cast<double>(kDefaultHoldUnits);
    EXPECT_LE(share, 1.02);
    EXPECT_GE(share, 0.98 / ratio);
}

TEST(HitAdvice, AVaseWithTheLongestEdgeThatIsAskedForFitsTheBudget) {
    const Model fine = vase(0.05f, 0.0075f);
    const double units = static_cast<double>(fine.report().units_of_a_hit);
    ASSERT_GT(units, 1.5 * static_cast<double>(kDefaultHoldUnits));
    const std::string& advice = fine.report().advice;
    const size_t at = advice.find("(longest_edge ");
    ASSERT_NE(at, std::string::npos) << advice;
    const float asked = 1e-3f * std::stof(advice.substr(at + 14));
    EXPECT_NEAR(asked / 0.0075,
                edge_for_units(mean_edge(fine), fine.report().units_of_a_hit, kDefaultHoldUnits) / mean_edge(fine),
                0.01);
    // Edges are halved until they fit, so that the mean goes up in small steps, and units with its cube.
    EXPECT_LE(static_cast<double>(vase(0.05f, asked).report().units_of_a_hit),
              1.15 * static_cast<double>(kDefaultHoldUnits));
}

TEST(HitAdvice, AMeshThatWasNotCutIsAskedToBeCoarserAlone) {
    EXPECT_EQ(vase(0.0045f).report().advice.find("longest_edge"), std::string::npos);
}

TEST(HitAdvice, EdgesAboveTwiceTheThicknessAreNotAskedFor) {
    const std::string text = hit_advice(1'000'000'000, 0.005, 0.004, 0);  // 13 mm would fit
    EXPECT_NE(text.find("8 mm instead of 5 mm"), std::string::npos) << text;
    EXPECT_NE(text.find("twice the thickness, would need 244 million"), std::string::npos) << text;
}

TEST(HitAdvice, WhereEdgesAreThatLongOnlyTheBudgetIsNamed) {
    const std::string text = hit_advice(1'000'000'000, 0.008, 0.004, 0.01);
    EXPECT_EQ(text.find("edges"), std::string::npos) << text;
    EXPECT_NE(text.find("units_a_frame"), std::string::npos) << text;
    EXPECT_EQ(hit_advice(kDefaultHoldUnits, 0.001, 0.004, 0), "");
}

}  // namespace
}  // namespace cullet
