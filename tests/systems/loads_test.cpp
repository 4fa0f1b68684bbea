// What lies on a body or squeezes it breaks it as soon as it is more than it bears.
#include <gtest/gtest.h>

#include "tests/support/play_script.hpp"

namespace cullet {
namespace {

using test::format;
using test::Played;

/// The script for so many seconds, at most until something breaks.
Played play_script(const std::string& text, double seconds, uint32_t threads = 2, bool stops = true) {
    return test::play_script(text, {seconds, 60, threads, stops});
}

const std::string kVase =
    "game.scene{shows = 'a load', seconds = 60} game.floor() "
    "local vase = game.cook{mesh = game.mesh.vase{height = 0.3, edge = 0.02}, material = 'porcelain', thickness = "
    "0.005, edge = 0.02} ";

// ---- squeezed

struct Press {
    const char* name;
    const char* script;  // of the press and what stands against it: %g is its speed
    double gap;          // m that it goes before it touches, at most
};
constexpr Press kPresses[] = {
    {"FromAbove", "game.kinematic{half_extents = {0.5, 0.1, 0.5}, at = {0, 0.41, 0}, velocity = {0, %g, 0}}", 0.01},
    {"FromTheSide",
     "game.box{low = {0.105, 0, -1}, high = {0.4, 1, 1}} "
     "game.kinematic{half_extents = {0.05, 0.5, 0.5}, at = {-0.16, 0.501, 0}, velocity = {%g, 0, 0}}",
     0.05},
    {"FromBelow",
     "game.box{low = {-1, 0.32, -1}, high = {1, 0.5, 1}} "
     "game.kinematic{half_extents = {0.5, 0.1, 0.5}, at = {0, -0.1, 0}, velocity = {0, %g, 0}}",
     0.03},
};
class SlowPress : public testing::TestWithParam<std::tuple<Press, double>> {};

TEST_P(SlowPress, BreaksAVaseBeforeItIsTwoCentimetresInIt) {
    const auto& [press, speed] = GetParam();
    const double along = std::string(press.name) == "FromAbove" ? -speed : speed;
    const std::string script = kVase + "game.spawn{cooked = vase, at = {0, 0.001, 0}} " + format(press.script, along);
    const double most = (press.gap + 0.02) / speed + 0.25;  // a hit takes some frames at any speed
    const Played played = play_script(script, most);
    EXPECT_EQ(played.failure, "");
    EXPECT_GT(played.pieces, 0u) << played.frames << " frames";
}
INSTANTIATE_TEST_SUITE_P(All, SlowPress, testing::Combine(testing::ValuesIn(kPresses), testing::Values(0.02, 0.1, 0.3)),
                         [](const auto& of) {
                             return std::string(std::get<0>(of.param).name) +
                                    std::to_string(static_cast<int>(1000 * std::get<1>(of.param))) +
                                    "MillimetresASecond";
                         });

// Its hidden run would take 11 frames, in which the press comes 4 cm. The first centimetre is air.
TEST(Loads, AFineVaseBreaksBeforeThePressIsTwoCentimetresInIt) {
    const Played played = play_script(
        "game.scene{shows = 'a load', seconds = 60} game.floor() "
        "game.spawn{mesh = game.mesh.vase{height = 0.3, edge = 0.006}, material = 'porcelain', thickness = 0.005, at = "
        "{0, 0.001, 0}} game.kinematic{half_extents = {0.5, 0.1, 0.5}, at = {0, 0.41, 0}, velocity = {0, -0.2, 0}}",
        0.15);
    EXPECT_EQ(played.failure, "");
    EXPECT_GT(played.pieces, 0u) << played.frames << " frames";
}

TEST(Loads, ALiftThatCarriesAVaseAndAPressThatStopsShortBreakNothing) {
    const Played played = play_script(
        kVase +
            "game.kinematic{half_extents = {0.5, 0.1, 0.5}, at = {0, 0.1, 0}, velocity = {0, 0.3, 0}} "
            "game.spawn{cooked = vase, at = {0, 0.2005, 0}} "
            "game.spawn{cooked = vase, at = {2, 0.001, 0}} "
            "local p = game.kinematic{half_extents = {0.5, 0.1, 0.5}, at = {2, 0.5, 0}, velocity = {0, -0.2, 0}} "
            "at(0.45, function() p:set_velocity{0, 0, 0} end)",
        4);
    EXPECT_EQ(played.failure, "");
    EXPECT_EQ(played.pieces, 0u);
}

TEST(Loads, ADoorThatClosesOnAPinnedPaneBreaksIt) {
    const Played played = play_script(
        "game.scene{shows = 'a door', seconds = 10} "
        "local pane = game.cook{mesh = game.mesh.pane{side = 0.5}, material = 'glass', thickness = 0.004, edge = 0.05} "
        "game.spawn{cooked = pane, at = {0, 1, 0}, pins = {{low = {-1, -1, -1}, high = {1, -0.24, 1}}, "
        "{low = {-1, 0.24, -1}, high = {1, 1, 1}}}} "
        "game.kinematic{half_extents = {0.1, 0.1, 0.1}, at = {0, 1, 0.15}, velocity = {0, 0, -0.1}}",
        1.2);
    EXPECT_EQ(played.failure, "");
    EXPECT_GT(played.pieces, 0u);
}

// ---- weights

TEST(Loads, AVaseCarriesTwentyKilogramsForFiveSecondsAtAnyRate) {
    for (const double rate : {20.0, 30.0, 60.0, 120.0}) {
        const Played played = test::play_script(
            kVase +
                "game.spawn{cooked = vase, at = {0, 0.001, 0}} "
                "local w = game.spawn{mesh = game.mesh.box{half_extents = {0.1, 0.05, 0.1}}, material = "
                "'steel', thickness = 0.04, breakable = false, at = {0, 0.352, 0}, edge = 0.2} "
                "wait(5) game.expect(w:mass() > 15, 'it weighs ' .. w:mass())",
            {5.2, rate});
        EXPECT_EQ(played.failure, "") << rate;
        EXPECT_EQ(played.pieces, 0u) << rate << " steps a second, " << played.frames;
    }
}

/// A vase of glass under a box of 28 kg under a ball.
std::string column(double wall, double mass) {
    return format(
        "game.scene{shows = 'a load', seconds = 60} game.floor() "
        "game.spawn{mesh = game.mesh.vase{height = 0.3, edge = 0.02}, material = 'glass', thickness = %g, at = {0, "
        "0.001, 0}} "
        "game.spawn{mesh = game.mesh.box{half_extents = {0.1, 0.05, 0.1}}, material = 'steel', thickness = 0.04, "
        "breakable = false, at = {0, 0.3515, 0}, edge = 0.2} "
        "game.throw{mass = %g, radius = 0.3, at = {0, 0.702, 0}, velocity = {0, 0, 0}}",
        wall, mass);
}

// It bears 12.9 kN where its wall is 5 mm. The solver passes on little by little what presses through something light,
// most of all where steps are long.
TEST(Loads, ATonneOnALightBoxBreaksAVaseOfThreeMillimetresAtAnyRateAndOneOfFiveCarriesSixHundredKilograms) {
    for (const double rate : {20.0, 30.0, 60.0, 120.0}) {
        const Played heavy = test::play_script(column(0.003, 1000), {0.5, rate});
        EXPECT_EQ(heavy.failure, "") << rate;
        EXPECT_GT(heavy.pieces, 0u) << rate << " steps a second";
        const Played light = test::play_script(column(0.005, 600), {0.5, rate});
        EXPECT_EQ(light.failure, "") << rate;
        EXPECT_EQ(light.pieces, 0u) << rate << " steps a second, " << light.frames;
    }
}

/// A shelf of glass, 1 x 0.04 x 0.3 m, on two supports 0.8 m apart, under a ball.
std::string shelf(double mass) {
    return format(
        "game.scene{shows = 'a shelf', seconds = 10} game.floor() "
        "game.box{low = {-0.5, 0, -0.2}, high = {-0.4, 0.5, 0.2}} game.box{low = {0.4, 0, -0.2}, high = {0.5, 0.5, "
        "0.2}} "
        "game.spawn{mesh = game.mesh.box{half_extents = {0.5, 0.02, 0.15}}, material = 'glass', thickness = 0.02, edge "
        "= "
        "0.05, at = {0, 0.5205, 0}} "
        "game.throw{mass = %g, radius = 0.15, at = {0, 0.691, 0}, velocity = {0, 0, 0}}",
        mass);
}

// Stress of a beam's middle, F L / (4 W) = 45 MPa with W = b h^2 / 6 = 8e-5 m3: 1.8 t.
TEST(Loads, AShelfBearsAThirdOfWhatABeamDoesAndBreaksAtTwice) {
    const Played light = play_script(shelf(600), 3);
    EXPECT_EQ(light.failure, "");
    EXPECT_EQ(light.pieces, 0u) << light.frames;
    const Played heavy = play_script(shelf(3700), 3);
    EXPECT_EQ(heavy.failure, "");
    EXPECT_GT(heavy.pieces, 0u);
}

TEST(Loads, AHundredTonnesBreakAShelfOfFourCentimetresWithinAThirdOfASecond) {
    const Played played = play_script(shelf(100000), 0.35);
    EXPECT_EQ(played.failure, "");
    EXPECT_GT(played.pieces, 0u);
}

TEST(Loads, ABreakByLoadIsTheSameOnAnyNumberOfThreads) {
    const std::string script =
        kVase + "game.spawn{cooked = vase, at = {0, 0.001, 0}} " + format(kPresses[0].script, -0.2);
    const uint64_t one = play_script(script, 1, 1, false).hash;
    for (const uint32_t threads : {2u, 3u, 8u}) EXPECT_EQ(play_script(script, 1, threads, false).hash, one);
}

}  // namespace
}  // namespace cullet
