// Hits that are foreseen: worked off before the touch, applied in its very frame, dropped where it comes otherwise.
#include <gtest/gtest.h>

#include <algorithm>

#include "components/state.hpp"
#include "systems/bodies/thresholds.hpp"
#include "systems/tasks/birth_cost.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

/// So many units that the hit takes about five frames.
Settings ahead_settings(uint32_t frames_ahead = 8) {
    Settings settings = small_settings();
    settings.units_a_frame = 5'000'000;
    settings.frames_ahead = frames_ahead;
    return settings;
}

/// The ball starts far enough away for all of its frames ahead.
Breakage far_ball(const Settings& settings, float speed = 8) {
    Breakage b = vase_and_ball(settings, speed);
    EXPECT_TRUE(b.world.set_pose(b.ball, {{0.01f, 0.13f, 1.6f}, {}}).ok());
    return b;
}

struct Play {
    uint32_t touch = 0, born = 0;  // frames
    uint64_t hits = 0, misses = 0, held = 0;
};
template <class Each>
Play play(World& world, uint32_t frames, Each&& each) {
    Play result;
    for (uint32_t frame = 1; frame <= frames; ++frame) {
        each(frame);
        world.step();
        if (world.events().impacts.count && !result.touch) result.touch = frame;
        if (world.events().fragments_born.count && !result.born) result.born = frame;
    }
    const DamageCounts& counts = world.contents().data.counts;
    result.hits = counts.ahead_hits, result.misses = counts.ahead_misses, result.held = counts.frames_held;
    return result;
}
constexpr auto kNothing = [](uint32_t) {};

TEST(Ahead, AHitOnAVaseBreaksItInTheFrameOfTheTouch) {
    Breakage slow = far_ball(ahead_settings(0)), b = far_ball(ahead_settings());
    expect_valid_after_each_system(b.world);
    const Play late = play(slow.world, 40, kNothing), ready = play(b.world, 40, kNothing);
    EXPECT_GT(late.held, 3u);
    EXPECT_GT(late.born, late.touch + 3);
    EXPECT_EQ(late.hits, 0u);
    EXPECT_EQ(ready.touch, late.touch);
    EXPECT_EQ(ready.born, ready.touch);
    EXPECT_EQ(ready.hits, 1u);
    EXPECT_EQ(ready.misses, 0u);
    EXPECT_EQ(ready.held, 0u);
    EXPECT_EQ(b.world.contents().data.counts.first_ready, 1u);
}

TEST(Ahead, BirthsArePaidFromTheUnitsOfTheirFrame) {
    Breakage b = far_ball(ahead_settings());
    const uint64_t budget = ahead_settings().units_a_frame;
    const State& state = state_of(b.world);
    uint64_t paid = 0, vertices = 0;
    for (int frame = 0; frame < 40 && paid == 0; ++frame) {
        for (uint32_t t = 0; t < state.tasks.size(); ++t)
            if (static_cast<TaskState>(state.tasks.state[t]) == TaskState::Whole)
                vertices = state.shells.vertices[state.shell_of(state.tasks.working[t])].count;
        b.world.step();
        if (b.world.events().fragments_born.count > 0) paid = b.world.report().units_used;
    }
    ASSERT_GT(vertices, 100u);
    EXPECT_EQ(paid, std::min(kUnitsBirth * vertices, budget / 2)) << "no other hit runs in the frame of the touch";
}

/// The same run from the same bits: the pieces are those of the hit that was held, and fly as long.
TEST(Ahead, WhatComesAsForeseenBreaksAsItWouldHaveAtTheTouch) {
    Breakage slow = far_ball(ahead_settings(0)), b = far_ball(ahead_settings());
    const Play late = play(slow.world, 40, kNothing), ready = play(b.world, 40, kNothing);
    (void)play(slow.world, late.born - ready.born, kNothing);
    const auto of_both = [](World& world) {
        std::vector<double> masses;
        for (const BodyId id : shells_of(world)) masses.push_back(world.mass(id).value());
        return masses;
    };
    EXPECT_GT(of_both(b.world).size(), 3u);
    EXPECT_EQ(of_both(slow.world), of_both(b.world));
    const Matter x = matter_of(slow.world), y = matter_of(b.world);
    EXPECT_NEAR(x.kinetic_energy, y.kinetic_energy, 1e-3 * x.kinetic_energy);
}

TEST(Ahead, ATouchThatComesFasterElsewhereOrNotAtAllIsAMiss) {
    for (const Vec3 instead : {Vec3{0, 0, -12}, Vec3{0.8f, 0, -8}, Vec3{0, 0, 8}}) {
        Breakage b = far_ball(ahead_settings());
        expect_valid_after_each_system(b.world);
        bool is_changed = false;
        const Play result = play(b.world, 60, [&](uint32_t) {
            if (is_changed || open_tasks(b.world) == 0) return;
            is_changed = true;
            ASSERT_TRUE(b.world.set_motion(b.ball, {instead, {}}).ok());
        });
        EXPECT_TRUE(is_changed);
        EXPECT_GE(result.misses, 1u);
        EXPECT_EQ(result.touch > 0, instead.z < 0);
        EXPECT_EQ(open_tasks(b.world), 0u);
        EXPECT_TRUE(result.born == 0 || result.born >= result.touch);
    }
}

// A second ball, from the other side, when the first one is seven frames away.
TEST(Ahead, AnEarlierTouchTakesThePlaceOfTheOneThatATaskIsFor) {
    Settings settings = ahead_settings();
    settings.units_a_frame = 20'000'000;
    Breakage b = far_ball(settings);
    expect_valid_after_each_system(b.world);
    uint32_t thrown = 0;
    const Play result = play(b.world, 40, [&](uint32_t frame) {
        if (thrown || open_tasks(b.world) == 0) return;
        thrown = frame;
        SphereSettings ball;
        ball.radius = 0.05f;
        ball.mass = 1;
        ball.pose.position = {0.01f, 0.13f, -0.75f};
        ball.motion.velocity = {0, 0, 8};
        EXPECT_TRUE(b.world.add_sphere(ball).ok());
    });
    ASSERT_GT(thrown, 0u);
    EXPECT_LT(result.touch, thrown + 7);
    EXPECT_EQ(result.born, result.touch);
    EXPECT_EQ(b.world.contents().data.counts.first_ready, 1u);
    EXPECT_GE(result.misses, 1u);
}

/// As far_ball, with another one that comes from the other side in the same frame.
SphereSettings ball_from_behind(float speed) {
    SphereSettings ball;
    ball.radius = 0.05f;
    ball.mass = 1;
    ball.pose.position = {0.01f, 0.13f, -1.68f};
    ball.motion.velocity = {0, 0, speed};
    return ball;
}

TEST(Ahead, TwoThatComeTogetherHaveOneTask) {
    Settings settings = ahead_settings();
    settings.units_a_frame = 20'000'000;
    Breakage b = far_ball(settings);
    expect_valid_after_each_system(b.world);
    ASSERT_TRUE(b.world.add_sphere(ball_from_behind(8)).ok());
    uint32_t contacts = 0;
    const Play result = play(b.world, 40, [&](uint32_t) {
        const Tasks& tasks = tasks_of(b.world);
        if (open_tasks(b.world) == 1) contacts = std::max(contacts, tasks.contact_count[0]);
    });
    EXPECT_EQ(contacts, 2u);
    EXPECT_EQ(result.hits, 1u);
    EXPECT_EQ(result.misses, 0u);
    EXPECT_EQ(result.born, result.touch);
    for (uint32_t q = 0; q < state_of(b.world).queued_hits.size(); ++q)
        EXPECT_FALSE(state_of(b.world).queued_hits.is_used[q]) << "the second one was left over";
}

/// To the frame in which the vase breaks: what its pieces hit then is counted, too.
template <class Each>
void play_until_it_breaks(World& world, Each&& each) {
    const DamageCounts& counts = world.contents().data.counts;
    for (uint32_t frame = 0; frame < 60 && counts.broke == 0; ++frame) {
        each();
        world.step();
    }
    EXPECT_EQ(counts.broke, 1u);
}

/// The second one turns back: what was worked off for both does not come.
TEST(Ahead, WhereOneOfTwoDoesNotComeIsAMiss) {
    Settings settings = ahead_settings();
    settings.units_a_frame = 20'000'000;
    Breakage b = far_ball(settings);
    const BodyId second = b.world.add_sphere(ball_from_behind(8)).value();
    const Tasks& tasks = tasks_of(b.world);
    bool is_turned = false;
    play_until_it_breaks(b.world, [&] {
        const bool waits = open_tasks(b.world) == 1 && tasks.contact_count[0] == 2 && tasks.due_frame[0] > 0;
        if (is_turned || !waits || static_cast<TaskState>(tasks.state[0]) == TaskState::Running) return;
        is_turned = true;
        ASSERT_TRUE(b.world.set_motion(second, {{0, 0, -8}, {}}).ok());
    });
    EXPECT_TRUE(is_turned);
    EXPECT_EQ(b.world.contents().data.counts.ahead_hits, 0u);
    EXPECT_EQ(b.world.contents().data.counts.ahead_misses, 1u);
}

TEST(Ahead, ABumpDoesNotTakeThePlaceOfAHit) {
    Settings settings = ahead_settings();
    settings.units_a_frame = 20'000'000;
    Breakage b = far_ball(settings);
    const State& state = state_of(b.world);
    SphereSettings bump =
        ball_from_behind(0.6f * first_crack_speed(state.structures, state.bodies.structure[b.body.index], 1));
    bump.pose.position.z = -0.2f;
    bool is_thrown = false, has_bumped = false;
    play_until_it_breaks(b.world, [&] {
        for (uint32_t q = 0; q < state.queued_hits.size(); ++q) has_bumped = has_bumped || state.queued_hits.is_used[q];
        if (is_thrown || open_tasks(b.world) == 0) return;
        is_thrown = true;
        EXPECT_TRUE(b.world.add_sphere(bump).ok());
    });
    EXPECT_TRUE(has_bumped);
    EXPECT_EQ(b.world.contents().data.counts.ahead_hits, 1u);
    EXPECT_EQ(b.world.contents().data.counts.ahead_misses, 0u);
    EXPECT_EQ(b.world.contents().data.counts.first_ready, 1u);
}

TEST(Ahead, AFlyingVaseBreaksOnTheFloorInTheFrameOfItsTouch) {
    Settings settings = ahead_settings();
    settings.gravity = {0, -9.81f, 0};
    World world = make_world(settings);
    (void)add_floor(world);
    SpawnSettings vase;
    vase.pose.position = {0, 1.2f, 0};
    vase.motion.velocity = {0.5f, -4, 0};
    vase.motion.angular_velocity = {1, 0, 2};
    (void)world.spawn(world.add_model(small_vase()).value(), vase).value();
    const Play result = play(world, 60, kNothing);
    EXPECT_GT(result.born, 0u);
    EXPECT_EQ(result.born, result.touch);
    EXPECT_EQ(world.contents().data.counts.first_ready, 1u);
}

TEST(Ahead, NobodyMissesABodyThatTheGameRemoves) {
    for (const bool is_striker : {false, true}) {
        Breakage b = far_ball(ahead_settings());
        expect_valid_after_each_system(b.world);
        bool is_gone = false;
        (void)play(b.world, 40, [&](uint32_t) {
            if (is_gone || open_tasks(b.world) == 0) return;
            is_gone = true;
            ASSERT_TRUE(b.world.remove(is_striker ? b.ball : b.body).ok());
        });
        EXPECT_TRUE(is_gone);
        EXPECT_EQ(open_tasks(b.world), 0u);
        EXPECT_EQ(b.world.bodies(nullptr, 0), 1u);
    }
}

TEST(Ahead, ABlowOfTheGameComesFirst) {
    Breakage b = far_ball(ahead_settings());
    expect_valid_after_each_system(b.world);
    bool is_struck = false;
    const Play result = play(b.world, 60, [&](uint32_t) {
        if (is_struck || open_tasks(b.world) == 0) return;
        is_struck = true;
        ASSERT_TRUE(b.world.push_impact(b.body, {.place = {0, 0.2f, 0.1f}, .normal = {0, 0, -1}}).ok());
    });
    EXPECT_TRUE(is_struck);
    EXPECT_EQ(result.misses, 1u);
    EXPECT_GT(result.born, 0u);
    EXPECT_EQ(open_tasks(b.world), 0u);
}

TEST(Ahead, AVetoIsAskedOnceAtTheTouch) {
    Breakage b = far_ball(ahead_settings());
    static int asked;
    asked = 0;
    b.world.set_veto([](void*, const ImpactEvent&) { return ++asked, false; }, nullptr);
    bool was_open = false;
    (void)play(b.world, 14, [&](uint32_t) { was_open = was_open || open_tasks(b.world) > 0; });
    EXPECT_TRUE(was_open);
    EXPECT_GT(asked, 0);
    EXPECT_EQ(b.world.contents().data.counts.opened, 0u);
    EXPECT_EQ(b.world.contents().data.counts.ahead_hits, 0u);
}

/// A saved world is rebuilt: it and the restored one go on together.
TEST(Ahead, ATaskThatRunsOrWaitsForItsTouchIsSavedWithTheWorld) {
    uint32_t running = 0, waiting = 0;
    for (int saved_at = 1; saved_at < 20; ++saved_at) {
        Breakage b = far_ball(ahead_settings());
        for (int frame = 0; frame < saved_at; ++frame) b.world.step();
        if (open_tasks(b.world) == 0) continue;
        const auto of_first = static_cast<TaskState>(tasks_of(b.world).state[0]);
        (of_first == TaskState::Running ? running : waiting) += 1;
        Result<std::vector<uint8_t>> bytes = b.world.snapshot();
        ASSERT_TRUE(bytes.ok()) << bytes.error();
        World restored = make_world(ahead_settings());
        ASSERT_TRUE(restored.restore(bytes.value().data(), bytes.value().size()).ok());
        for (int later = 0; later < 20; ++later) {
            restored.step(), b.world.step();
            ASSERT_EQ(restored.hash(), b.world.hash()) << saved_at << ", " << later;
        }
        EXPECT_GT(shells_of(restored).size(), 3u) << saved_at;
    }
    EXPECT_GT(running, 1u);
    EXPECT_GT(waiting, 0u);
}

TEST(Ahead, TheBytesAreTheSameOnAnyNumberOfThreads) {
    std::vector<uint64_t> hashes;
    for (const uint32_t threads : {1u, 2u, 3u, 8u}) {
        Settings settings = ahead_settings();
        settings.threads = threads;
        Breakage b = far_ball(settings);
        uint64_t chain = 0;
        (void)play(b.world, 40, [&](uint32_t) { chain = chain * 1099511628211u + b.world.hash(); });
        hashes.push_back(chain);
    }
    for (const uint64_t h : hashes) EXPECT_EQ(h, hashes.front());
}

}  // namespace
}  // namespace cullet::test
