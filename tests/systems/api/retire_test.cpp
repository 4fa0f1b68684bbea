// What a game does about old fragments: list, remove, freeze, merge; and debris that fades.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "components/body_id.hpp"
#include "components/state.hpp"
#include "cullet/recording.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

std::vector<FragmentAge> fragments_of(const World& world) {
    std::vector<FragmentAge> list(world.fragments(nullptr, 0));
    world.fragments(list.data(), static_cast<uint32_t>(list.size()));
    return list;
}

Settings settings_of(uint32_t births) {
    Settings settings = small_settings();
    settings.limits.births_a_frame = births;
    return settings;
}

/// A vase that came apart over some frames, and flies on.
Breakage broken(uint32_t births = 4) {
    Breakage b = vase_and_ball(settings_of(births), 12);
    for (int frame = 0; frame < 30; ++frame) b.world.step();
    EXPECT_GT(b.world.report().fragments, 8u);
    return b;
}

TEST(Retire, FragmentsAreListedOldestFirstAndThoseOfOneFrameByRow) {
    Breakage b = broken();
    const std::vector<FragmentAge> list = fragments_of(b.world);
    ASSERT_EQ(list.size(), b.world.report().fragments);
    EXPECT_GT(list.front().frames, list.back().frames) << "born over several frames";
    for (size_t i = 1; i < list.size(); ++i) {
        EXPECT_GE(list[i - 1].frames, list[i].frames);
        EXPECT_TRUE(list[i - 1].frames > list[i].frames || list[i - 1].fragment.index < list[i].fragment.index);
        EXPECT_EQ(list[i].mass, b.world.mass(list[i].fragment).value());
        EXPECT_FALSE(list[i].fragment == b.body) << "the largest piece keeps the handle";
    }
}

TEST(Retire, RemovesTheOldestWhoseHandlesAreStaleThen) {
    Breakage b = broken();
    const std::vector<FragmentAge> list = fragments_of(b.world);
    ASSERT_EQ(b.world.retire({.count = 3}).value_or(0), 3u);
    for (size_t i = 0; i < list.size(); ++i) EXPECT_EQ(b.world.is_alive(list[i].fragment), i >= 3) << i;
    EXPECT_FALSE(b.world.pose(list[0].fragment).ok());
    EXPECT_FALSE(b.world.remove(list[0].fragment).ok());
    EXPECT_EQ(fragments_of(b.world).front().fragment, list[3].fragment);
    EXPECT_EQ(b.world.report().retired, 3u);
    b.world.step();
}

TEST(Retire, OnlyThoseOldEnoughAndOnlySleepersWhenAsked) {
    Breakage b = broken();
    const std::vector<FragmentAge> list = fragments_of(b.world);
    const float oldest = static_cast<float>(list.front().frames) / 60;
    EXPECT_EQ(b.world.retire({.least_seconds = oldest + 0.01f}).value_or(9), 0u);
    EXPECT_EQ(b.world.retire({.only_asleep = true}).value_or(9), 0u) << "all of them fly";
    uint32_t as_old = 0;
    for (const FragmentAge& f : list) as_old += f.frames == list.front().frames;
    EXPECT_EQ(b.world.retire({.least_seconds = oldest - 0.001f}).value_or(0), as_old);
}

TEST(Retire, WhatIsFrozenStandsForGoodAndStopsOthers) {
    Breakage b = broken();
    const BodyId frozen = fragments_of(b.world).front().fragment;
    ASSERT_EQ(b.world.retire({.how = Retirement::Freeze, .count = 1}).value_or(0), 1u);
    ASSERT_TRUE(b.world.is_alive(frozen));
    const Vec3 place = centre_of(state_of(b.world).bodies, Row<Bodies>(frozen.index));
    const Vec3 before = b.world.pose(frozen)->position;
    EXPECT_FALSE(b.world.set_motion(frozen, {}).ok());
    for (int frame = 0; frame < 60; ++frame) b.world.step();  // the others leave
    SphereSettings ball;
    ball.radius = 0.02f;
    ball.mass = 5;
    ball.pose.position = place + Vec3{0, 0.6f, 0};
    ball.motion.velocity = {0, -6, 0};
    const BodyId striker = b.world.add_sphere(ball).value();
    for (int frame = 0; frame < 30; ++frame) b.world.step();
    EXPECT_EQ(b.world.pose(frozen)->position, before);
    const Vec3 velocity = b.world.motion(striker)->velocity;
    EXPECT_GT(length(velocity - Vec3{0, -6, 0}), 1.0f) << "it was turned away";
    for (const FragmentAge& f : fragments_of(b.world)) EXPECT_FALSE(f.fragment == frozen);
}

/// A pane that lies on the floor in pieces which sleep.
World sleeping_pieces() {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    World world = make_world(settings);
    add_floor(world);
    SpawnSettings pane;
    pane.pose = {{0, 0.3f, 0}, {0.644218f, 0, 0, 0.764842f}};
    const BodyId whole = world.spawn(world.add_model(small_pane()).value(), pane).value();
    for (int k = 0; k < 6; ++k) {
        CutSettings cut;
        const float share = 0.1f * static_cast<float>(k % 3) - 0.1f;
        cut.place = world.pose(whole)->position + Vec3{share, 0, share};
        cut.normal = k < 3 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
        EXPECT_TRUE(world.cut(whole, cut).ok());
    }
    for (int frame = 0; frame < 600; ++frame) world.step();
    return world;
}

TEST(Retire, WhatSleepsOnWhatIsFrozenSleepsOn) {
    World world = sleeping_pieces();
    const uint32_t awake = world.report().awake;
    const std::vector<FragmentAge> list = fragments_of(world);
    ASSERT_GT(list.size(), 3u);
    ASSERT_EQ(awake, 0u);
    EXPECT_EQ(world.retire({.how = Retirement::Freeze, .count = 2}).value_or(0), 2u);
    for (int frame = 0; frame < 30; ++frame) {
        world.step();
        EXPECT_EQ(world.report().awake, 0u) << frame;
    }
}

TEST(Retire, WorldsThatDifferInAgesAloneDifferInTheirHash) {
    Breakage b = broken();
    const uint64_t before = b.world.hash();
    const BodyId one = fragments_of(b.world).front().fragment;
    state_of(b.world).fragment_ages.born[one.index] += 1;
    EXPECT_NE(b.world.hash(), before);
}

TEST(Retire, WhatIsMergedIsDrawnAndMetByNothing) {
    Breakage b = broken();
    const BodyId merged = fragments_of(b.world).front().fragment;
    const uint32_t indices = b.world.view(merged)->index_count;
    const ShellView shell(state_of(b.world), state_of(b.world).bodies.structure[merged.index]);
    const Range vertices = shell.vertices(), elements = shell.elements();
    ASSERT_GT(elements.count, 0u);
    ASSERT_EQ(b.world.retire({.how = Retirement::Merge, .count = 1}).value_or(0), 1u);
    EXPECT_EQ(b.world.view(merged)->index_count, indices);
    const State& state = state_of(b.world);
    EXPECT_FALSE(state.vertices.pool.is_taken(vertices.first, vertices.capacity));
    EXPECT_FALSE(state.elements.pool.is_taken(elements.first, elements.capacity));
    EXPECT_EQ(state.validate(), "");
    const Vec3 before = b.world.pose(merged)->position;
    const Vec3 place = centre_of(state_of(b.world).bodies, Row<Bodies>(merged.index));
    for (int frame = 0; frame < 60; ++frame) b.world.step();
    SphereSettings ball;
    ball.radius = 0.02f;
    ball.pose.position = place + Vec3{0, 0.6f, 0};
    ball.motion.velocity = {0, -6, 0};
    const BodyId striker = b.world.add_sphere(ball).value();
    ASSERT_TRUE(b.world.explode({.centre = place, .radius = 0.2f, .impulse = 1}).ok());
    for (int frame = 0; frame < 6; ++frame) b.world.step();
    EXPECT_EQ(b.world.pose(merged)->position, before);
    EXPECT_TRUE(b.world.shift_origin({1, 0, 0}).ok());
    EXPECT_TRUE(b.world.set_pose(merged, {{0, 5, 0}, {}}).ok());
    for (int frame = 0; frame < 10; ++frame) b.world.step();
    EXPECT_LT(b.world.pose(striker)->position.y, place.y - 0.3f);
    // It goes through a snapshot, and can be removed.
    const auto bytes = b.world.snapshot();
    ASSERT_TRUE(bytes.ok());
    World other = make_world(settings_of(4));
    const Result<void> restored = other.restore(bytes->data(), bytes->size());
    ASSERT_TRUE(restored.ok()) << restored.error();
    EXPECT_EQ(other.hash(), b.world.hash());
    EXPECT_EQ(other.view(merged)->index_count, indices);
    EXPECT_TRUE(other.remove(merged).ok());
    EXPECT_FALSE(other.is_alive(merged));
    other.step();
}

TEST(Retire, RefusesWhatIsOutOfRange) {
    World world = make_world(small_settings());
    EXPECT_FALSE(world.retire({.least_seconds = -1}).ok());
    EXPECT_FALSE(world.retire({.least_seconds = std::nanf("")}).ok());
    EXPECT_FALSE(world.retire({.how = static_cast<Retirement>(9)}).ok());
    EXPECT_EQ(world.retire({}).value_or(1), 0u);
}

TEST(Retire, ARecordingWithItIsReplayedOnAnyNumberOfThreads) {
    const std::string path = (std::filesystem::temp_directory_path() / "cullet_retire.rec").string();
    {
        Breakage b = vase_and_ball(settings_of(3), 12);
        ASSERT_TRUE(b.world.start_recording(path).ok());
        for (int frame = 0; frame < 40; ++frame) {
            if (frame > 10)
                (void)b.world.retire({.how = static_cast<Retirement>(frame % 3), .count = 1, .least_seconds = 0.05f});
            b.world.step();
        }
        EXPECT_GT(b.world.report().retired, 6u);
        ASSERT_TRUE(b.world.stop_recording().ok());
    }
    ReplaySettings settings;
    settings.threads = {1, 2, 3, 8};
    const Result<ReplayReport> report = replay(path, settings);
    ASSERT_TRUE(report.ok()) << report.error();
    EXPECT_EQ(report->difference, "");
    EXPECT_EQ(report->damage, "");
    EXPECT_EQ(report->frames, 40u);
    std::filesystem::remove(path);
    std::filesystem::remove_all(path + ".models");
}

TEST(Retire, DebrisFadesAfterTheGamesTimeAndIsCounted) {
    Settings settings = small_settings();
    settings.debris_share = 0.02f;
    settings.debris_seconds = 0.25f;
    Breakage b = vase_and_ball(settings, 12);
    uint32_t made = 0, first = 0, gone = 0;
    for (uint32_t frame = 0; frame < 90; ++frame) {
        b.world.step();
        made += b.world.events().debris.count;
        if (made > 0 && first == 0) first = frame;
        if (frame < first + 15) {
            EXPECT_EQ(b.world.report().debris, made);
        }
        gone = static_cast<uint32_t>(b.world.report().faded);
    }
    ASSERT_GT(made, 0u);
    EXPECT_EQ(gone, made);
    EXPECT_EQ(b.world.report().debris, 0u);
}

}  // namespace
}  // namespace cullet::test
