// Metal shells in a world: rigid between impacts, dented by them, saved, loaded and replayed.
#include <gtest/gtest.h>

#include "components/body_id.hpp"
#include "sample_game/allocations.hpp"
#include "tests/support/closed_view.hpp"
#include "tests/support/same_bytes.hpp"
#include "tests/systems/models/metal_shell/panels.hpp"

namespace cullet {
namespace {

template <class T>
T value_of(Result<T> result) {
    if (!result) ADD_FAILURE() << result.error(), std::abort();
    return std::move(result).value();
}

const Model& panel() {
    static const Model model = test::cook_metal(metal_sheet(1, 1, 40, 40));
    return model;
}
const Model& box() {
    static const Model model = test::cook_metal(test::box_mesh({0.3, 0.3, 0.3}, 12));
    return model;
}

Settings settings_on(uint32_t threads) {
    Settings settings = test::small_settings();
    settings.gravity = {0, -9.81f, 0};
    settings.threads = threads;
    return settings;
}

BodyId spawn(World& world, const Model& model, Vec3 place, Vec3 velocity, Vec3 spin = {}) {
    SpawnSettings settings;
    settings.pose.position = place;
    settings.motion = {velocity, spin};
    return value_of(world.spawn(value_of(world.add_model(model)), settings));
}

/// Held along its border, in the x-y plane.
BodyId spawn_panel(World& world) {
    constexpr float kHalf = 0.5f, kRim = 0.01f, kOut = 1;
    const Box pins[] = {{{-kOut, -kOut, -kOut}, {-kHalf + kRim, kOut, kOut}},
                        {{kHalf - kRim, -kOut, -kOut}, {kOut, kOut, kOut}},
                        {{-kOut, -kOut, -kOut}, {kOut, -kHalf + kRim, kOut}},
                        {{-kOut, kHalf - kRim, -kOut}, {kOut, kOut, kOut}}};
    SpawnSettings settings;
    settings.pose.position = {0, 1, 0};
    settings.pins = pins, settings.pin_count = 4;
    return value_of(world.spawn(value_of(world.add_model(panel())), settings));
}

/// A ball into a framed panel, a box onto the floor, and two boxes at each other.
World crashes(const Settings& settings) {
    World world = test::make_world(settings);
    test::add_floor(world);
    spawn_panel(world);
    EXPECT_TRUE(world.add_sphere(test::ball_at({0.1f, 1, 0}, 50, 6, 0.1f)).ok());
    spawn(world, box(), {2, 0.2f, 0}, {1, -12, 0}, {3, 0, 4});
    spawn(world, box(), {-2, 1, 0}, {0, 0, -8}, {0.5f, 0, 0});
    spawn(world, box(), {-2, 1.05f, -0.8f}, {0, 0, 8});
    return world;
}

TEST(MetalWorld, ABallDentsAFramedPanelAndBouncesOff) {
    World world = test::make_world(settings_on(2));
    const BodyId sheet = spawn_panel(world);
    const BodyId ball = value_of(world.add_sphere(test::ball_at({0.1f, 1, 0}, 50, 6, 0.1f)));
    for (int frame = 0; frame < 30; ++frame) world.step();
    const double deep = test::deepest(world, sheet);
    EXPECT_GT(deep, 0.03);
    EXPECT_LT(deep, 0.12);
    EXPECT_GT(value_of(world.motion(ball)).velocity.z, 0);
    EXPECT_EQ(test::shells_of(world).size(), 1u) << "nothing comes off";
    EXPECT_EQ(test::find_open_edge(value_of(world.view(sheet))), "");
}

TEST(MetalWorld, ABoxThatFallsOnTheFloorIsDentedAndComesToRestWithAllItsMass) {
    World world = test::make_world(settings_on(2));
    test::add_floor(world);
    const BodyId thing = spawn(world, box(), {0, 0.3f, 0}, {0, -12, 0}, {1, 0, 2});
    for (int frame = 0; frame < 420; ++frame) world.step();
    EXPECT_GT(test::deepest(world, thing), 0.005);
    EXPECT_LT(test::deepest(world, thing), 0.2);
    EXPECT_NEAR(value_of(world.mass(thing)), box().report().mass, 1e-6 * box().report().mass);
    EXPECT_TRUE(value_of(world.is_asleep(thing)));
    EXPECT_EQ(test::find_open_edge(value_of(world.view(thing))), "");
    EXPECT_EQ(test::state_of(world).validate(), "");
}

TEST(MetalWorld, TwoBoxesThatMeetAreBothDentedAndKeepTheirMomentum) {
    World world = test::make_world(test::small_settings());
    const BodyId a = spawn(world, box(), {0, 0, 0.6f}, {0, 0, -8}, {0.5f, 0, 0});
    const BodyId b = spawn(world, box(), {0.02f, 0.01f, -0.2f}, {0, 0, 8});
    const auto before = test::matter_of(world).momentum;
    for (int frame = 0; frame < 40; ++frame) world.step();
    EXPECT_GT(test::deepest(world, a), 0.002);
    EXPECT_GT(test::deepest(world, b), 0.002);
    const auto after = test::matter_of(world).momentum;
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(after[k], before[k], 1e-3) << k;
}

TEST(MetalWorld, WhatTouchesItSoftlyLeavesItBitForBitAsItWas) {
    World world = test::make_world(settings_on(1));
    const BodyId sheet = spawn_panel(world);
    ASSERT_TRUE(world.add_sphere(test::ball_at({0, 1, 0}, 0.2f, 0.8f, 0.05f)).ok());
    for (int frame = 0; frame < 60; ++frame) world.step();
    EXPECT_EQ(test::deepest(world, sheet), 0);
}

TEST(MetalWorld, AnyNumberOfThreadsGivesTheSameBytes) {
    test::expect_same_on_threads([](uint32_t threads) { return crashes(settings_on(threads)); }, 60);
}

TEST(MetalWorld, AWorldThatIsLoadedGoesOnWithTheSameBytes) {
    World world = crashes(settings_on(1));
    EXPECT_GE(test::expect_loads(
                  world, [] { return test::make_world(settings_on(2)); }, 40, [](int frame) { return frame % 8 == 0; }),
              5u);
}

TEST(MetalWorld, ARecordingReplaysOnAnyNumberOfThreads) {
    test::expect_replays(settings_on(1), 40, [](World& world) {
        test::add_floor(world);
        spawn_panel(world);
        ASSERT_TRUE(world.add_sphere(test::ball_at({0.1f, 1, 0}, 50, 6, 0.1f)).ok());
        spawn(world, box(), {2, 0.2f, 0}, {1, -12, 0}, {3, 0, 4});
        for (int frame = 0; frame < 40; ++frame) world.step();
    });
}

TEST(MetalWorld, AModelFileGivesTheSameWorld) {
    const test::OwnFolder folder("cullet_metal_world_test");
    const std::string path = folder.file("box.cmodel");
    ASSERT_TRUE(write_model(box(), path).ok());
    const Model read = value_of(read_model(path));
    World cooked = test::make_world(settings_on(1)), from_file = test::make_world(settings_on(1));
    for (World* world : {&cooked, &from_file}) test::add_floor(*world);
    spawn(cooked, box(), {0, 0.2f, 0}, {1, -12, 0}, {3, 0, 4});
    spawn(from_file, read, {0, 0.2f, 0}, {1, -12, 0}, {3, 0, 4});
    EXPECT_EQ(test::hashes_of(from_file, 40), test::hashes_of(cooked, 40));
}

TEST(MetalWorld, FramesDoNotAllocate) {
    World world = crashes(settings_on(1));
    start_counting_allocations();
    for (int frame = 0; frame < 60; ++frame) world.step();
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
}

TEST(MetalWorld, ABodyOfManyPartsStaysOneBodyThroughSeveralHits) {
    Mesh parts = test::box_mesh({0.3, 0.3, 0.3}, 8);
    for (const double x : {0.31, 0.62, 1.2}) test::append(parts, test::box_mesh({0.3, 0.3, 0.3}, 8), {x, 0, 0});
    const Model model = test::cook_metal(parts);
    World world = test::make_world(settings_on(2));
    test::add_floor(world);
    const BodyId thing = spawn(world, model, {0, 0.3f, 0}, {0, -10, 0}, {0.5f, 0, 3});
    for (int frame = 0; frame < 240; ++frame) world.step();
    EXPECT_EQ(test::shells_of(world).size(), 1u);
    EXPECT_GT(test::deepest(world, thing), 0.005);
    EXPECT_NEAR(value_of(world.mass(thing)), model.report().mass, 1e-6 * model.report().mass);
    EXPECT_EQ(test::find_open_edge(value_of(world.view(thing))), "");
    EXPECT_EQ(test::state_of(world).validate(), "");
}

TEST(MetalWorld, TenHitsOnOneSpotDigDeeperAndStaySane) {
    World world = test::make_world(settings_on(2));
    const BodyId sheet = spawn_panel(world);
    double last = 0;
    for (int hit = 0; hit < 10; ++hit) {
        const BodyId ball = value_of(world.add_sphere(test::ball_at({0, 1, 0}, 50, 5, 0.1f)));
        for (int frame = 0; frame < 20; ++frame) world.step();
        ASSERT_TRUE(world.remove(ball).ok());
        const double deep = test::deepest(world, sheet);
        EXPECT_GE(deep, last - 0.005) << hit;
        last = deep;
    }
    EXPECT_LT(last, 0.2);
    EXPECT_EQ(test::state_of(world).validate(), "");
}

}  // namespace
}  // namespace cullet
