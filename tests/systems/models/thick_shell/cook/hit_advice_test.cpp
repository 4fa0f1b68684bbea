// The advice that cooking gives is followed: the model that it asks for fits the budget.
#include "systems/models/thick_shell/cook/hit_advice.hpp"

#include <gtest/gtest.h>

#include "cullet/world.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
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
    return model.contents->state.shells.mean_edge[model.contents->state.shell_of(model.contents->shell)];
}

HitOfModel hit_of(const Model& model) {
    const Workbench& state = model.contents->state;
    const Row<Structures> shell = model.contents->shell;
    return {model.report().units_of_a_hit,
            state.shells.vertices[state.shell_of(shell)].count,
            false,
            mean_edge(model),
            state.shells.thickness[state.shell_of(shell)],
            0};
}
/// The number behind the words, in the unit that follows it; 0 where the words are not there.
double number_after(const std::string& text, const std::string& words) {
    const size_t at = text.find(words);
    return at == text.npos ? 0 : std::stod(text.substr(at + words.size()));
}
const MeanEdgeWhenSplitAt kNoSplit = [](double) { return 0.0; };

TEST(HitAdvice, AVaseWithTheEdgesThatAreAskedForFitsTheBudget) {
    const Model fine = vase(0.0045f);
    ASSERT_GT(fine.report().units_of_a_hit, 2 * kDefaultHoldUnits);
    const double asked = edge_for_units(hit_of(fine), kDefaultHoldUnits);
    // The lathe makes edges in proportion to what it is told.
    const Model coarse = vase(static_cast<float>(0.0045 * asked / mean_edge(fine)));
    EXPECT_NEAR(mean_edge(coarse) / asked, 1, 0.05);
    // Between the third power, which is asked by, and the fourth, where hinges limit the step.
    const double ratio = asked / mean_edge(fine),
                 share = static_cast<double>(coarse.report().units_of_a_hit) / static_cast<double>(kDefaultHoldUnits);
    EXPECT_LE(share, 1.02);
    EXPECT_GE(share, 0.98 / ratio);
}

// Each remedy alone is followed, over fine and coarse meshes that the setting cut or not, of thin and thick walls.
struct Pot {
    float height, edge, longest_edge, thickness;
};
Model cooked(const Pot& pot) {
    CookSettings settings;
    settings.thickness = pot.thickness;
    settings.longest_edge = pot.longest_edge;
    settings.thick_shell.measures_threshold = false;
    return test::cook_vase(pot.height, pot.edge, settings).value();
}
constexpr Pot kPots[] = {
    {0.30f, 0.0045f, 100, 0.005f},   {0.30f, 0.005f, 100, 0.003f},    {0.30f, 0.05f, 0.0075f, 0.005f},
    {0.30f, 0.05f, 0.009f, 0.008f},  {0.30f, 0.02f, 0.007f, 0.006f},  {0.30f, 0.0125f, 0.0085f, 0.006f},
    {1.00f, 0.06f, 0.022f, 0.02f},   {1.00f, 0.017f, 0.016f, 0.025f}, {0.30f, 0.006f, 0.0055f, 0.004f},
    {0.50f, 0.0075f, 0.006f, 0.01f},
};

TEST(HitAdvice, IsGoneWhenTheMeshIsCookedWithTheEdgesItNames) {
    uint32_t with_setting = 0, with_mesh = 0;
    for (const Pot& pot : kPots) {
        const std::string advice = cooked(pot).report().advice;
        Pot other = pot;
        if (const double length = number_after(advice, "a longest edge of "); length > 0) {
            ++with_setting;
            EXPECT_NEAR(number_after(advice, " mm in place of "), 1e3 * pot.longest_edge, 0.01) << advice;
            other.longest_edge = static_cast<float>(1e-3 * length);
            EXPECT_GT(other.longest_edge, pot.longest_edge) << advice;
        } else if (const double edge = number_after(advice, "edges of about "); edge > 0) {
            ++with_mesh;
            // The lathe makes edges in proportion to what it is told.
            const double now = mean_edge(cooked({pot.height, pot.edge, 100, pot.thickness}));
            other.edge = static_cast<float>(pot.edge * 1e-3 * edge / now);
            other.longest_edge = 100;
        } else {
            continue;
        }
        const ModelReport& after = cooked(other).report();
        EXPECT_EQ(after.advice, "") << pot.edge << " " << pot.longest_edge << " " << pot.thickness << ": " << advice;
        EXPECT_LE(after.units_of_a_hit, kDefaultHoldUnits);
    }
    EXPECT_GE(with_setting, 3u);
    EXPECT_GE(with_mesh, 3u);
}

TEST(HitAdvice, IsGoneInAWorldWithTheUnitsItNames) {
    struct Heard {
        uint32_t sentences = 0;
        static void log(void* user, LogLevel, const char*) { ++static_cast<Heard*>(user)->sentences; }
    } heard;
    Host host;
    host.user = &heard;
    host.log = &Heard::log;
    const Model model = cooked(kPots[0]);
    const auto named = static_cast<uint64_t>(1e6 * number_after(model.report().advice, "units_a_frame to "));
    ASSERT_GT(named, Settings().units_a_frame);
    for (const uint64_t units : {Settings().units_a_frame, named - named / 8, named}) {
        heard.sentences = 0;
        Settings settings;
        settings.units_a_frame = units;
        World world = World::create(settings, host).value();
        ASSERT_TRUE(world.add_model(model).ok());
        EXPECT_EQ(heard.sentences, units < named ? 1u : 0u) << units;
    }
}

TEST(HitAdvice, QuickIsNamedFirst) {
    const std::string advice = cooked(kPots[0]).report().advice;
    const size_t quick = advice.find("break quickly"), units = advice.find("units_a_frame"),
                 edges = advice.find("edges");
    EXPECT_LT(quick, units) << advice;
    EXPECT_LT(units, edges) << advice;
    EXPECT_NE(edges, std::string::npos) << advice;
}

TEST(HitAdvice, AMeshThatIsFinerThanTheSettingIsNotAskedForALongerOne) {
    EXPECT_EQ(vase(0.0045f).report().advice.find("longest edge"), std::string::npos);
    // The setting made the edges what they are, but those of the mesh are too short as well.
    const HitOfModel hit{1'000'000'000, 3000, false, 0.005, 0.02, 0.006};
    const std::string text = hit_advice(hit, [](double length) { return std::min(0.8 * length, 0.008); });
    EXPECT_EQ(text.find("longest edge"), std::string::npos) << text;
    EXPECT_NE(text.find("a mesh with edges of about"), std::string::npos) << text;
}

TEST(HitAdvice, EdgesAboveTwiceTheThicknessAreNotAskedFor) {
    const HitOfModel hit{1'000'000'000, 3000, false, 0.005, 0.004, 0};  // 13 mm would fit
    const std::string text = hit_advice(hit, kNoSplit);
    EXPECT_EQ(text.find("edges"), std::string::npos) << text;
    EXPECT_NE(text.find("units_a_frame to 142.9 million"), std::string::npos) << text;
    EXPECT_NE(hit_advice({1'000'000'000, 3000, false, 0.005, 0.012, 0}, kNoSplit).find("edges"), std::string::npos);
}

TEST(HitAdvice, NothingIsSaidOfWhatFits) {
    EXPECT_EQ(hit_advice({kDefaultHoldUnits, 3000, false, 0.001, 0.004, 0}, kNoSplit), "");
}

// Of a large body only the steps count, until it is small enough to be simulated whole.
TEST(HitAdvice, ALargeBodyIsAskedForEdgesWithWhichItsHitFits) {
    const double mean = 0.005;
    for (const uint32_t vertices : {9000u, 20000u, 200000u})
        for (const uint64_t units : {60'000'000ull, 200'000'000ull, 2'000'000'000ull}) {
            const double ratio = edge_for_units({units, vertices, true, mean, 0.1, 0}, kDefaultHoldUnits) / mean,
                         left = vertices / (ratio * ratio),
                         share = left > kWholeHiddenVertices * (1 + 1e-9) ? 1 : left / kWholeCopyVertices;
            EXPECT_LE(static_cast<double>(units) / ratio * share, 1.001 * kDefaultHoldUnits)
                << vertices << " " << units;
        }
}

}  // namespace
}  // namespace cullet
