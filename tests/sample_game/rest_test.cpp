// What counts as fallen through, and how far meshes lie apart. settling_test asks both of the scenes.
#include "sample_game/rest.hpp"

#include <gtest/gtest.h>

#include "sample_game/game_world.hpp"
#include "sample_game/mesh_gap.hpp"
#include "sample_game/run_scene.hpp"

namespace cullet {
namespace {

/// Bodies of the script's world that fell through, after so many frames.
uint64_t fallen_through(const std::string& text, uint32_t frames) {
    RunOptions options;
    options.threads = 1;
    Result<GameWorld> game = GameWorld::create(plan_scene({"test", "test.lua", text}, options));
    EXPECT_TRUE(game.ok()) << game.error();
    for (uint32_t f = 0; f < frames; ++f) game->before_step(), game->step(), game->after_step();
    return measure_rest(*game, 1).through;
}

TEST(FallenThrough, WhatRollsOffAFloorOrDownASlopesEndDoesNotCount) {
    EXPECT_EQ(fallen_through("game.floor{half_side = 1}\ngame.throw{radius = 0.1, mass = 1, at = {0.8, 0.1, 0}, "
                             "velocity = {2, 0, 0}}",
                             90),
              0u);
    EXPECT_EQ(fallen_through("game.static{mesh = game.mesh.pane{side = 1, edge = 0.5}}\n"
                             "game.throw{radius = 0.1, mass = 1, at = {0, 2, 0.4}, velocity = {0, 0, 2}}",
                             90),
              0u);
}

TEST(FallenThrough, WhatLiesUnderATableOrARoofOnAFloorDoesNotCount) {
    const std::string ball = "game.throw{radius = 0.1, mass = 1, at = {0, 0.1, 0}}\n";
    EXPECT_EQ(fallen_through("game.floor()\ngame.static{mesh = game.mesh.table{}}\n" + ball, 30), 0u);
    EXPECT_EQ(fallen_through("game.floor()\ngame.box{low = {-1, 1, -1}, high = {1, 2, 1}}\n" + ball, 30), 0u);
    EXPECT_EQ(fallen_through("game.floor{height = -3}\ngame.box{low = {-1, -1, -1}, high = {1, 0, 1}}\n" + ball, 30),
              0u);
}

TEST(FallenThrough, WhatIsBelowAFloorOrInsideItCounts) {
    const std::string ball = "game.throw{radius = 0.1, mass = 1, at = {0, -";
    EXPECT_EQ(fallen_through("game.setting{gravity_mps2 = 0}\ngame.floor()\n" + ball + "2, 0}}", 1), 1u);
    EXPECT_EQ(fallen_through("game.floor()\n" + ball + "2, 0}}", 60), 1u);
    EXPECT_EQ(
        fallen_through(
            "game.setting{gravity_mps2 = 0}\ngame.box{low = {-1, -4, -1}, high = {1, 0, 1}}\n" + ball + "2, 0}}", 0),
        1u);
}

TEST(MeshGap, OfParallelTrianglesIsTheirHeight) {
    const Corners a{Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 0, 1}};
    const Corners b{Vec3d{0.2, 0.3, 0.2}, Vec3d{1.2, 0.3, 0.2}, Vec3d{0.2, 0.3, 1.2}};
    EXPECT_NEAR(triangle_gap(a, b), 0.3, 1e-15);
}

TEST(MeshGap, OfEdgesThatCrossApartIsTheirDistance) {
    const Corners a{Vec3d{-1, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, -5, 0}};
    const Corners b{Vec3d{0, 0.2, -1}, Vec3d{0, 0.2, 1}, Vec3d{0, 5, 0}};
    EXPECT_NEAR(triangle_gap(a, b), 0.2, 1e-15);
}

TEST(MeshGap, OfTrianglesThatCutEachOtherIsZero) {
    const Corners a{Vec3d{-1, 0, -1}, Vec3d{1, 0, -1}, Vec3d{0, 0, 2}};
    const Corners b{Vec3d{0, -1, 0}, Vec3d{0.1, 1, 0}, Vec3d{0, -1, 0.1}};
    EXPECT_EQ(triangle_gap(a, b), 0);
}

TEST(MeshGap, OfAPointBesideATriangleIsThatToItsSide) {
    const Corners a{Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 0, 1}};
    EXPECT_NEAR(point_gap({0.5, 0.3, -0.4}, a), 0.5, 1e-15);
    EXPECT_NEAR(point_gap({-3, 4, 0}, a), 5, 1e-15);
}

}  // namespace
}  // namespace cullet
