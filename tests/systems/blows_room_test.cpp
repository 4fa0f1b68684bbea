// More blows than there is room, work or memory for: what comes of those that were accepted.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

BodyId add_vase(World& world, Vec3 place = {}) {
    SpawnSettings settings;
    settings.pose.position = place;
    return world.spawn(world.add_model(small_vase()).value(), settings).value();
}

/// Flat, against the side of a vase at the origin, at mid-height.
PushSettings side_push(const World& world, BodyId body, float speed) {
    const Bodies& bodies = world.contents().data.state.bodies;
    PushSettings push;
    push.place = bodies.position[body.index] + bodies.centre[body.index].to_float() + Vec3{0, 0, 0.1f};
    push.normal = {0, 0, -1};
    push.approach_speed = speed;
    push.mass = 0.3f;
    return push;
}

double momentum_along_z(const World& world) {
    return matter_of(world).momentum[2];
}

Settings crowded_settings() {
    Settings settings = small_settings();
    settings.limits.bodies = 8;
    settings.limits.queued_hits = 4;
    return settings;
}

TEST(BlowsRoom, EveryPushThatWasAcceptedMovesItsBody) {
    World one = make_world(crowded_settings());
    const BodyId vase = add_vase(one);
    ASSERT_TRUE(one.push_impact(vase, side_push(one, vase, 0.002f)).ok());
    one.step();
    const double wanted = momentum_along_z(one);
    ASSERT_LT(wanted, 0);

    World world = make_world(crowded_settings());
    const BodyId first = add_vase(world), second = add_vase(world, {1, 0, 0});
    for (int i = 0; i < 12; ++i) {
        const BodyId struck = i % 2 ? second : first;
        ASSERT_TRUE(world.push_impact(struck, side_push(world, struck, 0.002f)).ok()) << i;
    }
    const Result<void> refused = world.push_impact(first, side_push(world, first, 0.002f));
    EXPECT_NE(refused.error().find("limits.queued_hits"), std::string::npos) << refused.error();
    world.step();
    EXPECT_NEAR(momentum_along_z(world), 12 * wanted, 1e-4 * 12 * -wanted);
    EXPECT_EQ(world.events().refused.count, 0u);
    EXPECT_EQ(state_of(world).blows.size(), 0u);
}

// What reaches all bodies must not take the rows of what was asked of one.
TEST(BlowsRoom, ExplosionsBeforeThemLeavePushesTheirRoom) {
    const auto momentum_after = [](bool explodes, bool pushes) {
        World world = make_world(crowded_settings());
        ExplosionSettings explosion;
        explosion.centre = {1.25f, 0.15f, 1};
        explosion.radius = 3;
        explosion.impulse = 0.02f;
        for (int i = 0; i < 6; ++i) (void)add_vase(world, {0.5f * static_cast<float>(i), 0, 0});
        for (int i = 0; i < 6 && explodes; ++i) EXPECT_TRUE(world.explode(explosion).ok());
        for (const BodyId vase : shells_of(world)) {
            if (!pushes) break;
            EXPECT_TRUE(world.push_impact(vase, side_push(world, vase, 0.002f)).ok());
        }
        world.step();
        EXPECT_EQ(world.contents().data.counts.opened, 0u);
        EXPECT_EQ(state_of(world).blows.size(), 0u);
        return momentum_along_z(world);
    };
    const double exploded = momentum_after(true, false), pushed = momentum_after(false, true);
    EXPECT_LT(exploded, 0);
    EXPECT_LT(pushed, 0);
    EXPECT_NEAR(momentum_after(true, true), exploded + pushed, -1e-4 * (exploded + pushed));
}

TEST(BlowsRoom, EveryCutThatWasAcceptedIsMade) {
    Settings settings = small_settings();
    settings.limits.bodies = 16;
    settings.limits.queued_hits = 4;
    World world = make_world(settings);
    const BodyId vase = add_vase(world);
    for (int i = 0; i < 11; ++i) {
        CutSettings cut;
        cut.place = {0, 0.05f + 0.02f * static_cast<float>(i), 0};
        ASSERT_TRUE(world.cut(vase, cut).ok()) << i;
    }
    // One working copy has no room for all of them: the rest goes on, piece by piece.
    for (int frame = 0; frame < 60; ++frame) world.step();
    EXPECT_EQ(shells_of(world).size(), 12u);
    EXPECT_EQ(state_of(world).blows.size(), 0u);
}

TEST(BlowsRoom, EveryBlowThatJoinsATaskIsTold) {
    Settings settings = small_settings();
    settings.limits.open_hits = 1;
    World world = make_world(settings);
    const BodyId vase = add_vase(world);
    ExplosionSettings explosion;
    explosion.centre = {0, 0.15f, 0.2f};
    explosion.impulse = 60;
    for (int i = 0; i < 5; ++i) ASSERT_TRUE(world.explode(explosion).ok());
    world.step();
    ASSERT_EQ(world.contents().data.counts.opened, 1u);
    ASSERT_EQ(world.events().impacts.count, 5u);
    for (const ImpactEvent& e : world.events().impacts) EXPECT_EQ(e.body, vase);
}

TEST(BlowsRoom, ACutWhoseMeshFindsNoRoomIsNamedAndMadeWhenThereIs) {
    // Panes until there is no room for another's drawn mesh: the last one has no rows to spare for what cracks add.
    // Each has a mesh of its own, as it has pins of its own.
    Settings settings = small_settings();
    settings.limits.view_vertices = 6300;
    World world = make_world(settings);
    const ModelId model = world.add_model(small_pane()).value();
    std::vector<BodyId> panes;
    for (int i = 0; i < 16; ++i) {
        SpawnSettings spawn;
        spawn.pose.position = {static_cast<float>(i), 0, 0};
        const Box foot{{-1, -1, -1}, {1, 0.001f, 1}};
        spawn.pins = &foot, spawn.pin_count = 1;
        const Result<BodyId> pane = world.spawn(model, spawn);
        if (!pane) break;
        panes.push_back(*pane);
    }
    ASSERT_GE(panes.size(), 2u);
    ASSERT_LT(panes.size(), 16u);
    // Cracks that free no piece.
    const float x = world.pose(panes.back()).value().position.x;
    const Vec3 line[] = {{x - 0.08f, 0.1f, 0}, {x + 0.02f, 0.17f, 0}, {x + 0.09f, 0.15f, 0}};
    CutSettings cut;
    cut.points = line;
    cut.point_count = 3;
    ASSERT_TRUE(world.cut(panes.back(), cut).ok());
    const auto has_cracks = [&] {
        return state_of(world).structures.has_cracks[state_of(world).bodies.structure[panes.back().index]] != 0;
    };
    bool is_named = false;
    for (int frame = 0; frame < 4; ++frame) {
        world.step();
        for (const RefusedEvent& e : world.events().refused)
            is_named = is_named || (e.body == panes.back() && std::string(e.setting) == "limits.view_vertices");
    }
    EXPECT_TRUE(is_named);
    EXPECT_FALSE(has_cracks());
    ASSERT_EQ(state_of(world).blows.size(), 1u) << "it waits";
    ASSERT_TRUE(world.remove(panes[0]).ok());
    for (int frame = 0; frame < 8; ++frame) world.step();
    EXPECT_TRUE(has_cracks());
    EXPECT_EQ(state_of(world).blows.size(), 0u);
}

TEST(BlowsRoom, CutsAreMadeWhileTheFramesUnitsLast) {
    for (const uint64_t units : {200'000, 50'000}) {
        Settings settings = small_settings();
        settings.units_a_frame = units;
        World world = make_world(settings);
        const ModelId model = world.add_model(small_pane()).value();
        for (int i = 0; i < 7; ++i) {
            SpawnSettings spawn;
            spawn.pose.position = {static_cast<float>(i), 0, 0};
            ASSERT_TRUE(world.spawn(model, spawn).ok());
        }
        CutSettings cut;
        cut.place = {0, 0.15f, 0};
        ASSERT_TRUE(world.cut({}, cut).ok());
        uint64_t opened = 0, frames = 0;
        for (; opened < 7 && frames < 20; ++frames) {
            world.step();
            const DamageCounts& counts = world.contents().data.counts;
            const uint64_t now = counts.opened - opened;
            EXPECT_GE(now, 1u) << "none starves";
            EXPECT_LE(now, units == 50'000 ? 1u : 2u);
            EXPECT_GT(counts.units_used, units / 4) << "they are paid for";
            opened = counts.opened;
        }
        EXPECT_EQ(frames, units == 50'000 ? 7u : 4u);
        EXPECT_EQ(shells_of(world).size(), 14u);
        EXPECT_EQ(state_of(world).blows.size(), 0u);
    }
}

}  // namespace
}  // namespace cullet::test
