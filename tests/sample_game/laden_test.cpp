// Heavy things on light ones, and tall towers, stand.
#include <gtest/gtest.h>

#include "sample_game/game_world.hpp"
#include "sample_game/run_scene.hpp"

namespace cullet {
namespace {

std::string failure_after(const std::string& text, double seconds) {
    RunOptions options;
    options.threads = 1;
    Result<GameWorld> game = GameWorld::create(plan_scene({"laden", "laden.lua", text}, options));
    if (!game.ok()) return game.error();
    for (uint32_t f = 0; f < 60 * seconds; ++f) game->before_step(), game->step(), game->after_step();
    game->before_step();
    return game->failure();
}

// Three boxes of 9 kg, and one of at least `times` as much: its wall decides.
std::string column(double wall, double size, int times) {
    return "local size, wall, times = " + std::to_string(size) + ", " + std::to_string(wall) + ", " +
           std::to_string(times) + R"(
        game.scene{shows = 'a heavy box on three light ones', seconds = 21} game.floor()
        local light = game.cook{mesh = game.mesh.box{half_extents = {0.2, 0.2, 0.2}}, material = 'porcelain', thickness = 0.004, edge = 0.4}
        local lowest
        for k = 0, 2 do
            local box = game.spawn{cooked = light, breakable = false, at = {0, 0.2 + 0.4005 * k, 0}}
            lowest = lowest or box
        end
        local heavy = game.spawn{mesh = game.mesh.box{half_extents = {0.2, size, 0.2}}, material = 'steel', thickness = wall, edge = 0.4,
                                 breakable = false, at = {0, 0.2015 + 0.4 * 2.5 + size, 0}}
        game.expect(heavy:mass() >= times * lowest:mass(), string.format('%.0f kg are not %d times %.1f kg', heavy:mass(), times, lowest:mass()))
        wait(20)
        local p = heavy:position()
        game.expect(math.max(math.abs(p.x), math.abs(p.z)) < 0.01 and math.abs(p.y - 1.2 - size) < 0.01,
                    string.format('%.0f kg stand %.1f and %.1f mm aside, %.1f mm off', heavy:mass(), 1000 * p.x, 1000 * p.z, 1000 * (p.y - 1.2 - size))))";
}

TEST(Laden, ABoxThirtyTimesAsHeavyStandsOnThreeLightOnesForTwentySeconds) {
    EXPECT_EQ(failure_after(column(0.05, 0.2, 30), 20.5), "");
}
TEST(Laden, ABoxAHundredTimesAsHeavyStandsOnThreeLightOnesForTwentySeconds) {
    EXPECT_EQ(failure_after(column(0.19, 0.39, 100), 20.5), "");
}

TEST(Laden, ATowerOfFortyBoxesStandsForTwentySeconds) {
    EXPECT_EQ(failure_after(R"(
        game.scene{shows = 'a tower', seconds = 21} game.floor()
        local box = game.cook{mesh = game.mesh.box{half_extents = {0.2, 0.2, 0.2}}, material = 'porcelain', thickness = 0.02, edge = 0.4}
        local all = {}
        for k = 0, 39 do all[k + 1] = game.spawn{cooked = box, breakable = false, at = {0, 0.2002 + 0.4002 * k, 0}} end
        wait(20)
        for k = 1, 40 do
            local p = all[k]:position()
            game.expect(math.max(math.abs(p.x), math.abs(p.z)) < 0.02 and math.abs(p.y - 0.4 * k + 0.2) < 0.03,
                        string.format('box %d is %.1f and %.1f mm aside, %.1f mm off', k, 1000 * p.x, 1000 * p.z, 1000 * (p.y - 0.4 * k + 0.2)))
        end)",
                            20.5),
              "");
}

}  // namespace
}  // namespace cullet
