// Debris: what it keeps of the piece that it was, and what it falls on.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

constexpr float kRadius = 0.005f;

Settings falling() {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    return settings;
}

uint32_t throw_debris(World& world, Vec3 place, Vec3 velocity) {
    Debris& debris = state_of(world).debris;
    const uint32_t row = debris.append(1);
    debris.is_used[row] = 1;
    debris.position.set(row, place);
    debris.velocity.set(row, velocity);
    debris.mass[row] = 0.001;
    debris.radius[row] = kRadius;
    debris.floor[row] = -1e6f;
    set_born(state_of(world).debris_ages, row, 0);
    return row;
}

void step(World& world, int frames) {
    for (int frame = 0; frame < frames; ++frame) world.step();
}

/// Its top at y = 0.5.
BodyId add_table(World& world) {
    KinematicSettings table;
    table.pose.position = {0, 0.45f, 0};
    table.half_extents = {0.3f, 0.05f, 0.3f};
    return world.add_kinematic_box(table).value();
}

TEST(Debris, FallsOffTheTableToTheGround) {
    World world = make_world(falling());
    add_floor(world);
    add_table(world);
    const uint32_t stays = throw_debris(world, {-0.1f, 0.6f, 0}, {}),
                   leaves = throw_debris(world, {0, 0.6f, 0}, {4, 0, 0});
    const Debris& debris = state_of(world).debris;
    step(world, 180);
    EXPECT_NEAR(debris.position[stays].y, 0.5f + kRadius, 0.002f);
    EXPECT_NEAR(debris.position[leaves].y, kRadius, 0.002f);
    EXPECT_TRUE(debris.is_resting[leaves]);
    EXPECT_GT(debris.position[leaves].x, 0.5f);
}

TEST(Debris, WhatItRestsOnGoesAndItFallsOn) {
    World world = make_world(falling());
    add_floor(world);
    const Vec3 corners[] = {{-1, 0.5f, -1}, {-1, 0.5f, 1}, {1, 0.5f, 1}, {1, 0.5f, -1}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    const BodyId shelf = world.add_static({corners, 4, quad, 2}).value();
    const uint32_t row = throw_debris(world, {0, 0.6f, 0}, {});
    const Debris& debris = state_of(world).debris;
    step(world, 60);
    EXPECT_TRUE(debris.is_resting[row]);
    EXPECT_NEAR(debris.position[row].y, 0.5f + kRadius, 0.002f);
    ASSERT_TRUE(world.remove(shelf).ok());
    step(world, 120);
    EXPECT_TRUE(debris.is_resting[row]);
    EXPECT_NEAR(debris.position[row].y, kRadius, 0.002f);
}

TEST(Debris, NoSpeedTakesItThroughALargeBody) {
    World world = make_world(small_settings());
    const Box all{{-1, -1, -1}, {1, 1, 1}};
    SpawnSettings pane;
    pane.pins = &all;
    pane.pin_count = 1;
    (void)world.spawn(world.add_model(small_pane()).value(), pane).value();
    std::vector<uint32_t> rows;
    for (int k = 0; k < 60; ++k)
        rows.push_back(throw_debris(world,
                                    {0.01f * static_cast<float>(k % 10) - 0.05f,
                                     0.1f + 0.01f * static_cast<float>(k / 10), 0.3f + 0.007f * static_cast<float>(k)},
                                    {0, 0, -1.0f - 3 * static_cast<float>(k)}));
    const Debris& debris = state_of(world).debris;
    for (int frame = 0; frame < 40; ++frame) {
        world.step();
        for (const uint32_t row : rows) EXPECT_GT(debris.position[row].z, 0) << row << ", frame " << frame;
    }
    for (const uint32_t row : rows) EXPECT_GE(debris.velocity[row].z, 0) << row;
}

TEST(Debris, NothingThatMovesMakesItFasterThanItWas) {
    World world = make_world(small_settings());
    KinematicSettings ram;
    ram.pose.position = {0, 0, -1};
    ram.motion.velocity = {0, 0, 3};
    (void)world.add_kinematic_box(ram).value();
    const uint32_t row = throw_debris(world, {0, 0, 0}, {0, 0, -1});
    const Debris& debris = state_of(world).debris;
    for (int frame = 0; frame < 60; ++frame) {
        world.step();
        EXPECT_LE(length(debris.velocity[row]), 1.0f + 1e-5f);
    }
    EXPECT_GT(debris.velocity[row].z, 0.9f) << "it was turned round";
}

TEST(Debris, KeepsMassAndMomentumOfTheSliversThatItIsMadeOf) {
    Settings settings = small_settings();
    settings.debris_share = 0.02f;
    Breakage b = vase_and_ball(settings, 12);
    uint32_t made = 0;
    const Matter before = matter_of(b.world);
    Matter after;
    after_each_system(b.world, [&](const std::string& system) {
        if (system == "make_births") after = matter_of(b.world);  // before they fly into something
    });
    for (int frame = 0; frame < 40 && made == 0; ++frame) {
        b.world.step();
        made = b.world.events().debris.count;
    }
    ASSERT_GT(made, 0u);
    EXPECT_GT(after.debris_mass, 0);
    EXPECT_NEAR(after.mass, before.mass, 1e-6 * before.mass);
    double moved = 0, carried = 0;
    for (int k = 0; k < 3; ++k)
        moved += std::fabs(after.momentum[k] - before.momentum[k]), carried += std::fabs(before.momentum[k]);
    EXPECT_LT(moved, 1e-3 * carried);
}

TEST(Debris, FallsAlikeOnAnyNumberOfThreads) {
    std::vector<uint64_t> first;
    for (const uint32_t threads : {1u, 2u, 3u, 8u}) {
        Settings settings = falling();
        settings.threads = threads;
        settings.debris_share = 0.02f;
        Breakage b = vase_and_ball(settings, 12);
        add_floor(b.world);
        std::vector<uint64_t> hashes;
        for (int frame = 0; frame < 60; ++frame) b.world.step(), hashes.push_back(b.world.hash());
        EXPECT_GT(b.world.report().debris, 0u);
        if (first.empty()) first = hashes;
        EXPECT_EQ(hashes, first) << threads << " threads";
    }
}

}  // namespace
}  // namespace cullet::test
