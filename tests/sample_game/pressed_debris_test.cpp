// What is ground to debris under a press stays above the floor, at any rate of steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <span>

#include "sample_game/game_world.hpp"
#include "sample_game/run_scene.hpp"
#include "systems/world_contents.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/play_script.hpp"

namespace cullet::test {
namespace {

/// A sheet of 20 m by 20 m of `cells` by `cells` squares, two triangles each, whose corners lie up to so many m below
/// y = 0; the line of script with its file.
std::string sheet(int cells, double rough) {
    const std::string path = testing::TempDir() + format("pressed_debris_%d.obj", cells);
    std::ofstream file(path);
    for (int z = 0; z <= cells; ++z)
        for (int x = 0; x <= cells; ++x)
            file << format("v %.9g %.9g %.9g\n", -10 + 20.0 * x / cells,
                           -rough * ((x * 7919 + z * 104729) % 101) / 100.0, -10 + 20.0 * z / cells);
    for (int z = 0; z < cells; ++z)
        for (int x = 0; x < cells; ++x) {
            const int a = z * (cells + 1) + x + 1, b = a + cells + 1;
            file << format("f %d %d %d\nf %d %d %d\n", a, b, b + 1, a, b + 1, a + 1);
        }
    return "game.static{mesh = game.mesh.file{path = '" + path + "'}}";
}

struct Pressed {
    double deepest = 0;  // m, of the centre of a grain below y = 0, at any time
    uint64_t seen = 0;   // grains, times frames
};

/// A vase of so many m under a press.
void press_vase(const std::string& floor, double rate, double height, Pressed& pressed) {
    RunOptions options;
    options.threads = 1;
    options.dt_ms = 1000 / rate;
    const std::string script = "game.scene{shows = 'a press', seconds = 4}\n" + floor +
                               format(R"(
        local vase = game.mesh.vase{height = %g, edge = 0.02}
        game.spawn{mesh = vase, material = 'glass', thickness = 0.005, at = {0, 0.001, 0}}
        local press = game.kinematic{half_extents = {0.5, 0.1, 0.5}, at = {0, %g, 0}}
        press:set_velocity{0, -0.2, 0}
        wait(1.7)
        press:set_velocity{0, 0, 0})",
                                      height, 0.15 + height);
    Result<GameWorld> game = GameWorld::create(plan_scene({"script", "script.lua", script}, options));
    ASSERT_TRUE(game.ok()) << game.error();
    for (uint32_t frame = 0; frame < 3 * rate; ++frame) {
        game->before_step(), game->step(), game->after_step();
        const Debris& debris = game->world().contents().data.state.debris;
        for (uint32_t d = 0; d < debris.size(); ++d) {
            if (!debris.is_used[d]) continue;
            ++pressed.seen;
            pressed.deepest = std::max(pressed.deepest, -static_cast<double>(debris.position[d].y));
        }
    }
    EXPECT_EQ(game->failure(), "");
}

// The press pushed them a centimetre into the floor in a step, and what was deeper than that fell for ever.
TEST(PressedDebris, NoneGoesThroughAFloor) {
    Pressed pressed;
    for (const double rate : {20.0, 30.0, 60.0}) press_vase("game.floor()", rate, 0.3, pressed);
    EXPECT_LE(pressed.deepest, 0);
    EXPECT_GT(pressed.seen, 400u);
}

// Faces that are pushed out by a grain's radius leave a gap over each ridge.
TEST(PressedDebris, NoneGoesThroughASheetOfTriangles) {
    struct Sheet {
        int cells;
        double rough;  // m
    };
    constexpr double kHeights[] = {0.3, 0.302};  // m
    for (const Sheet& of : {Sheet{1, 0}, Sheet{60, 0.005}, Sheet{230, 0.005}}) {
        Pressed pressed;
        for (const double rate : {20.0, 30.0, 60.0})
            for (const double height : std::span(kHeights).first(few_or_all(1u, 2u))) {
                press_vase(sheet(of.cells, of.rough), rate, height, pressed);
                EXPECT_LE(pressed.deepest, of.rough)
                    << of.cells << " cells, " << rate << " steps a second, vase of " << height << " m";
            }
        EXPECT_GT(pressed.seen, 400u);
    }
}

}  // namespace
}  // namespace cullet::test
