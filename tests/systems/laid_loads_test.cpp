// What lies under a load decides whether it bends: a floor, or two edges and nothing but the thing's weight.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <span>

#include "tests/support/effort.hpp"
#include "tests/support/play_script.hpp"

namespace cullet {
namespace {

using test::format;
using test::play_script;
using test::Played;

constexpr double kGravity = 9.81;
const std::string kScene = "game.scene{shows = 'a load', seconds = 60} game.floor() ";

/// A pane of glass in whose middle `weight` N on two far edges gives a stress of F L / (4 W) = 45 MPa.
struct Pane {
    double length, height, width;
    explicit Pane(std::mt19937& engine) {
        const auto within = [&](double low, double high) {
            return low + (high - low) * static_cast<double>(engine() >> 8) / 0x1000000;
        };
        length = within(1, 2);
        height = within(0.005, 0.012) * length;
        width = within(0.3, 0.8) * length;
    }
    double borne() const { return 45e6 * 4 * width * height * height / (6 * length); }
    std::string spawn(double low) const {
        return format(
            "game.spawn{mesh = game.mesh.box{half_extents = {%g, %g, %g}}, material = 'glass', thickness = %g, edge = "
            "%g, at = {0, %g, 0}} ",
            length / 2, height / 2, width / 2, height / 2, length / 12, low + height / 2);
    }
    /// A block of steel of this weight, N, whose least side is a tenth of the length.
    std::string block(double weight, double x, double low) const {
        const double half = 0.05 * length, across = 0.4 * width, high = weight / kGravity / (7850 * 4 * half * across);
        return format(
            "game.spawn{mesh = game.mesh.box{half_extents = {%g, %g, %g}}, material = 'steel', thickness = %g, edge = "
            "1, breakable = false, at = {%g, %g, 0}} ",
            half, high / 2, across, 0.45 * std::min(high, 2 * half), x, low + high / 2);
    }
};

TEST(LaidLoads, APaneThatLiesFlatBearsThreeTimesWhatWouldBreakItOnTwoEdges) {
    for (uint32_t seed = 1; seed <= 8; ++seed) {
        std::mt19937 engine(seed);
        const Pane pane(engine);
        std::string script = kScene + pane.spawn(0.0003);
        for (const double x : {-0.35, 0.0, 0.35})
            script += pane.block(pane.borne(), x * pane.length, 0.001 + pane.height);
        const Played played = play_script(script, {1, seed % 2 ? 60.0 : 120.0});
        ASSERT_EQ(played.failure, "") << script;
        EXPECT_EQ(played.pieces, 0u) << "seed " << seed << ", " << played.seconds << " s: " << script;
    }
}

/// Two sheets of two triangles each and a gap between them, m; the file's path.
std::string sheets_beside_a_gap(double gap) {
    const std::string path = testing::TempDir() + format("sheets_beside_a_gap_%g.obj", gap);
    std::ofstream file(path);
    for (const double x : {-gap / 2 - 1, -gap / 2, gap / 2, gap / 2 + 1})
        for (const double z : {-2.0, 2.0}) file << "v " << x << " 0 " << z << '\n';
    file << "f 1 2 4\nf 1 4 3\nf 5 6 8\nf 5 8 7\n";
    return path;
}

// What is below the middle of the pane belongs to the same mesh as what bears it.
TEST(LaidLoads, APaneOverAGapOfAMeshBreaksUnderTwiceWhatItBearsThereAndStandsAtAHalf) {
    for (uint32_t seed = 1; seed <= 6; ++seed) {
        std::mt19937 engine(100 + seed);
        const Pane pane(engine);
        const double gap = 0.8 * pane.length, borne = pane.borne() * pane.length / gap;
        for (const double share : {0.45, 2.0}) {
            const std::string script =
                "game.scene{shows = 'a load', seconds = 60} game.static{mesh = game.mesh.file{path = '" +
                sheets_beside_a_gap(gap) + "'}} " + pane.spawn(0.0003) +
                format("game.throw{mass = %.9g, radius = 0.15, at = {0, %.9g, 0}, velocity = {0, 0, 0}} ",
                       share * borne / kGravity, pane.height + 0.1513);
            const Played played = play_script(script, {1, seed % 2 ? 60.0 : 120.0});
            ASSERT_EQ(played.failure, "") << script;
            EXPECT_EQ(played.pieces > 0, share > 1) << "seed " << seed << ", " << played.seconds << " s: " << script;
        }
    }
}

/// Stress in the middle, 3 rho g L^2 / 4 h, over 45 MPa, of a strip on two edges; it is a fourteenth of it wide.
Played play_strip(double share, double height, double rate) {
    const double length = std::sqrt(share * 45e6 * 4 * height / (3 * 2500 * kGravity)), half = length / 2;
    std::string script = kScene;
    for (const double side : {-1.0, 1.0})
        script += format("game.box{low = {%g, 0, -1}, high = {%g, 0.5, 1}} ", side < 0 ? -half - 0.2 : half - 0.01,
                         side < 0 ? -half + 0.01 : half + 0.2);
    script += format(
        "game.spawn{mesh = game.mesh.box{half_extents = {%g, %g, %g}}, material = 'glass', thickness = %g, edge = %g, "
        "at = {0, %g, 0}}",
        half, height / 2, length / 28, height / 2, length / 30, 0.5002 + height / 2);
    return play_script(script, {1, rate});
}

TEST(LaidLoads, AStripBreaksUnderItsOwnWeightWhereABeamDoesAndStandsAtAHalf) {
    constexpr double kRates[] = {60, 30, 120};  // steps a second
    for (const double height : {0.002, 0.005, 0.012})
        for (const double rate : std::span(kRates).first(test::few_or_all(1u, 3u))) {
            const Played light = play_strip(0.45, height, rate), heavy = play_strip(1.6, height, rate);
            ASSERT_EQ(light.failure + heavy.failure, "");
            EXPECT_EQ(light.pieces, 0u) << height << " m, " << rate << " steps a second";
            EXPECT_GT(heavy.pieces, 0u) << height << " m, " << rate << " steps a second";
        }
}

// Each of the light ones has some contacts of its own, and the heavy one comes last.
TEST(LaidLoads, TheLastOfManyThatAreLaidOnASlabBreaksIt) {
    std::string script = kScene +
                         "game.box{low = {-1, 0, -1}, high = {-0.8, 0.5, 1}} game.box{low = {0.8, 0, -1}, high = {1, "
                         "0.5, 1}} "
                         "game.spawn{mesh = game.mesh.box{half_extents = {1, 0.02, 1}}, material = 'glass', thickness "
                         "= 0.02, edge = 0.1, at = {0, 0.5205, 0}} "
                         "local small = game.cook{mesh = game.mesh.box{half_extents = {0.03, 0.005, 0.03}}, material "
                         "= 'wood', thickness = 0.004, edge = 1} "
                         "for k = 0, 99 do game.spawn{cooked = small, breakable = false, at = {-0.7 + 1.4 * (k % 2), "
                         "0.547, -0.95 + 0.038 * (k // 2)}} end "
                         "game.throw{mass = 12000, radius = 0.2, at = {0, 0.742, 0}, velocity = {0, 0, 0}}";
    const Played played = play_script(script, {1, 60});
    ASSERT_EQ(played.failure, "");
    EXPECT_GT(played.pieces, 0u);
}

}  // namespace
}  // namespace cullet
