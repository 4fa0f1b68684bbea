// What closes on a breakable thing breaks it however slowly it comes; what moves along with it does not.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/play_script.hpp"

namespace cullet {
namespace {

using test::format;
using test::play_script;
using test::Played;

struct Draw {
    std::mt19937 engine;
    double within(double low, double high) {
        return low + (high - low) * static_cast<double>(engine() >> 8) / 0x1000000;
    }
};

/// A box, a vase or a hollow ball of this size in the middle between two walls, and how wide it is, m.
std::string thing(Draw& draw, double size, double& width) {
    const auto kind = static_cast<uint32_t>(draw.engine() % 3);
    const double wall = draw.within(0.015, 0.03) * size, edge = 0.1 * size;
    width = kind == 1 ? 0.66 * size : size;
    const std::string mesh =
        kind == 0 ? format("game.mesh.slab{width = %g, height = %g, thickness = %g, vertices = 500}", size, size, size)
        : kind == 1 ? format("game.mesh.vase{height = %g, edge = %g}", size, edge)
                    : format("game.mesh.ball{radius = %g, subdivisions = 3}", size / 2);
    return format(
        "local thing = game.spawn{mesh = %s, material = 'porcelain', thickness = %g, edge = %g, at = {0, %g, 0}} ",
        mesh.c_str(), wall, edge, kind == 2 ? 0.501 * size : 0.001 * size);
}

/// Two walls, a little farther apart than the thing is wide, that turn about a vertical axis and may go along, too.
/// `closing`: m/s, of each towards the other.
std::string turning_walls(Draw& draw, double closing) {
    const double size = std::exp2(draw.within(-3, 0));
    double width = 0;
    const std::string of = thing(draw, size, width);
    const double gap = width / 2 + 0.01 * size, half = 0.15 * size,
                 spin = draw.within(0.1, 0.6) * (draw.engine() % 2 ? 1 : -1);
    const double speed = draw.within(0, 0.3) * size;
    return "game.scene{shows = 'walls that turn together', seconds = 10} game.floor{friction = 0.05} " + of +
           format(
               "local walls = {} for i, s in ipairs{-1, 1} do walls[i] = game.kinematic{half_extents = {%g, %g, %g}, "
               "at = {s * %g, %g, 0}, friction = 0.3} end "
               "local steps, angle = 0, 0 local x = 0 "
               "every({frames = 1}, function() steps = steps + 1 local w = %g * math.min(1, steps / 60) "
               "local v = %g * math.min(1, steps / 60) local p, q = walls[1]:position(), walls[2]:position() "
               "local cx, cz = (p.x + q.x) / 2, (p.z + q.z) / 2 "
               "for i, wall in ipairs(walls) do local r = wall:position() local dx, dz = r.x - cx, r.z - cz "
               "local far = math.sqrt(dx * dx + dz * dz) "
               "wall:set_velocity{w * dz + v - %g * dx / far, 0, -w * dx - %g * dz / far} wall:set_spin{0, w, 0} end "
               "end) ",
               half, 0.6 * size, 0.9 * size, gap + half, 0.62 * size, spin, speed, closing, closing);
}

TEST(ClosingLoads, WallsThatTurnAndGoTogetherBreakNothingBetweenThem) {
    for (uint32_t seed = 1; seed <= 8; ++seed) {
        Draw draw{std::mt19937(seed)};
        const std::string script = turning_walls(draw, 0);
        const Played played = play_script(script, {3, seed % 2 ? 60.0 : 120.0});
        ASSERT_EQ(played.failure, "") << script;
        EXPECT_EQ(played.pieces, 0u) << "seed " << seed << ", " << played.seconds << " s: " << script;
    }
}

TEST(ClosingLoads, WallsThatCloseWhileTheyTurnBreakWhatIsBetweenThem) {
    for (uint32_t seed = 1; seed <= 8; ++seed) {
        Draw draw{std::mt19937(seed)};
        const std::string script = turning_walls(draw, 0.01);
        const Played played = play_script(script, {6, seed % 2 ? 60.0 : 120.0});
        ASSERT_EQ(played.failure, "") << script;
        EXPECT_GT(played.pieces, 0u) << "seed " << seed << ": " << script;
    }
}

// Slower than a millimetre a second nothing is driven until it is deep: a tenth of a wall, from either side.
TEST(ClosingLoads, APressThatCreepsBreaksAThingBeforeItIsHalfAWallInIt) {
    for (uint32_t seed = 1; seed <= 8; ++seed) {
        Draw draw{std::mt19937(100 + seed)};
        const double size = std::exp2(draw.within(-4, -1)), wall = 0.02 * size;
        const double speed = draw.within(2e-4, 9e-4), gap = 0.002 * size;
        double width = 0;
        const std::string script =
            "game.scene{shows = 'a slow press', seconds = 60} game.floor() " + thing(draw, size, width) +
            format("game.kinematic{half_extents = {%g, %g, %g}, at = {0, %g, 0}, velocity = {0, %g, 0}}", size,
                   0.2 * size, size, 1.2 * size + 0.001 * size + gap, -speed);
        const double most = (gap + 0.002 * size + 0.5 * wall) / speed + 0.5;
        const Played played = play_script(script, {most, seed % 2 ? 60.0 : 120.0});
        ASSERT_EQ(played.failure, "") << script;
        EXPECT_GT(played.pieces, 0u) << "seed " << seed << ", whole after " << played.seconds << " s: " << script;
    }
}

}  // namespace
}  // namespace cullet
