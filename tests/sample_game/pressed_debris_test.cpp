// What is ground to debris under a press stays above the floor, at any rate of steps.
#include <gtest/gtest.h>

#include <algorithm>

#include "sample_game/game_world.hpp"
#include "sample_game/run_scene.hpp"
#include "systems/world_contents.hpp"
#include "tests/support/play_script.hpp"

namespace cullet::test {
namespace {

/// m, of the centre of the deepest below y = 0, at any time.
double deepest_debris(const std::string& floor, double rate, uint64_t& seen) {
    RunOptions options;
    options.threads = 1;
    options.dt_ms = 1000 / rate;
    Result<GameWorld> game = GameWorld::create(
        plan_scene({"script", "script.lua", "game.scene{shows = 'a press', seconds = 4}\n" + floor + R"(
        local vase = game.mesh.vase{height = 0.3, edge = 0.02}
        game.spawn{mesh = vase, material = 'glass', thickness = 0.005, at = {0, 0.001, 0}}
        local press = game.kinematic{half_extents = {0.5, 0.1, 0.5}, at = {0, 0.45, 0}}
        press:set_velocity{0, -0.2, 0}
        wait(1.7)
        press:set_velocity{0, 0, 0})"},
                   options));
    EXPECT_TRUE(game.ok()) << game.error();
    if (!game.ok()) return 1;
    double deepest = 0;
    for (uint32_t frame = 0; frame < 3 * rate; ++frame) {
        game->before_step(), game->step(), game->after_step();
        const Debris& debris = game->world().contents().data.state.debris;
        for (uint32_t d = 0; d < debris.size(); ++d) {
            if (!debris.is_used[d]) continue;
            ++seen;
            deepest = std::max(deepest, -static_cast<double>(debris.position[d].y));
        }
    }
    EXPECT_EQ(game->failure(), "");
    return deepest;
}

// The press pushed them a centimetre into the floor in a step, and what was deeper than that fell for ever.
// Not yet so on a sheet of triangles: one grain of six such presses goes through it, at 30 steps a second.
TEST(PressedDebris, NoneGoesThroughAFloor) {
    uint64_t seen = 0;  // grains, times frames
    for (const double rate : {20.0, 30.0, 60.0}) EXPECT_LE(deepest_debris("game.floor()", rate, seen), 0) << rate;
    EXPECT_GT(seen, 400u);
}

}  // namespace
}  // namespace cullet::test
