// What broke comes to rest: measured on the drawn meshes after ten seconds of each scene.
#include "sample_game/rest.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "sample_game/game_world.hpp"
#include "sample_game/mesh_gap.hpp"
#include "sample_game/run_scene.hpp"

namespace cullet {
namespace {

constexpr uint32_t kFrames = 600;

struct Case {
    const char* scene;
    int seed;
};

Rest rest_of(const Case& c) {
    RunOptions options;
    options.scene = c.scene;
    options.set.push_back("scene.seed=" + std::to_string(c.seed));
    options.threads = 2;
    options.frames = kFrames;
    options.hash = HashWhen::Off;
    const Scene& scene = *find_scene(options.scene);
    const Result<Report> report = play(plan_scene(scene, options), options);
    EXPECT_TRUE(report.ok()) << report.error();
    if (!report.ok()) return {};
    const Rest& rest = report->rest;
    std::printf(
        "%s %d: %.1f %% asleep, kinetic share %.2g, sink %.2f and %.2f mm, into each other %.2f and %.2f mm, hover "
        "%.2f mm, hulls %.2f mm\n",
        scene.name.c_str(), c.seed, 100 * rest.asleep_share, rest.kinetic_share, rest.sink_p95_mm, rest.sink_max_mm,
        rest.overlap_p95_mm, rest.overlap_max_mm, rest.hover_max_mm, rest.hover_hulls_max_mm);
    return rest;
}

class SceneRest : public testing::TestWithParam<Case> {};

TEST_P(SceneRest, TenSecondsAfterTheStartNearlyAllSleepAndNothingSinksHoversOrFallsThrough) {
    const Rest rest = rest_of(GetParam());
    EXPECT_GT(rest.measured, 3u);
    EXPECT_GE(rest.asleep_share, 0.95);
    EXPECT_LT(rest.kinetic_share, 1e-4);
    EXPECT_LT(rest.sink_p95_mm, 2);
    EXPECT_LT(rest.sink_max_mm, 4);
    EXPECT_LT(rest.overlap_max_mm, 4);
    EXPECT_LT(rest.hover_p95_mm, 1);
    EXPECT_LT(rest.hover_max_mm, 1);
    EXPECT_LT(rest.hover_boxes_max_mm, 6);  // a slab of 0.3 m whose box is 1.15 times it: half of 4 % a side
    // One that is 1.4 times it may fill notches: those of a wall's slab, which lies on its edge, by 12 mm at 1.09.
    EXPECT_LT(rest.hover_hulls_max_mm, 15);
    EXPECT_EQ(rest.through, 0u);
}

// Slabs of a wall reach two metres and lean on each other. Convex parts fill notches of their outlines: in one wall of
// eight a slab hovers for it by more than a millimetre (of 120 walls; up to 24 mm; what has a single hull up to 38). A
// rate needs more walls than three.
TEST(ThirtyWalls, ComeToRestAndHardlyAnyHovers) {
    uint32_t awake = 0, deep = 0, hovering = 0;
    for (int seed = 1; seed <= 30; ++seed) {
        const Rest rest = rest_of(Case{"wall", seed});
        EXPECT_GT(rest.measured, 3u);
        EXPECT_LT(rest.kinetic_share, 1e-3);
        EXPECT_LT(rest.sink_max_mm, 4);
        EXPECT_LT(rest.hover_max_mm, 25);
        EXPECT_LT(rest.hover_hulls_max_mm, 50);
        EXPECT_EQ(rest.through, 0u);
        awake += rest.asleep_share<0.95, deep += rest.overlap_max_mm> 4, hovering += rest.hover_max_mm > 1;
    }
    std::printf("of 30: %u not asleep, %u with slabs 4 mm in each other, %u hovering\n", awake, deep, hovering);
    EXPECT_LE(awake, 2u);
    EXPECT_LE(deep, 3u);
    EXPECT_LE(hovering, 6u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneRest, testing::Values(Case{"vase", 1}, Case{"pane", 1}, Case{"drop", 1}),
                         [](const auto& scene) { return scene.param.scene + std::to_string(scene.param.seed); });

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
