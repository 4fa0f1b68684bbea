// Blows give the same bytes on any number of threads, after a save in the middle, in a replay, and to a host's bodies.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "components/state.hpp"
#include "cullet/recording.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

Settings sliced_settings(uint32_t threads) {
    Settings settings = small_settings();
    settings.units_a_frame = 2'500'000;
    settings.gravity = {0, -9.81f, 0};
    settings.threads = threads;
    return settings;
}

/// Two vases and a pane over a floor, and a ball.
void furnish(World& world) {
    const ModelId vase = world.add_model(small_vase()).value(), pane = world.add_model(small_pane()).value();
    add_floor(world);
    SpawnSettings settings;
    settings.pose.position = {0, 0.002f, 0};
    (void)world.spawn(vase, settings).value();
    settings.pose.position = {0.4f, 0.3f, 0};
    (void)world.spawn(vase, settings).value();
    settings.pose.position = {-0.5f, 0.1f, 0};
    settings.motion.angular_velocity = {1, 2, 0};
    (void)world.spawn(pane, settings).value();
    (void)world.add_sphere(ball_at({0.2f, 0.2f, 0}, 0.3f, 0)).value();
}

void expect_done(const Result<void>& done) {
    EXPECT_TRUE(done.ok()) << done.error();
}

/// What is asked before step `frame`: blows of all kinds, two on one body in one frame, more while the last still run.
void ask(World& world, int frame) {
    const std::vector<BodyId> bodies = shells_of(world);
    PushSettings push;
    push.place = {0, 0.15f, 0.08f};
    push.normal = {0, 0, -1};
    push.approach_speed = 9;
    push.mass = 0.4f;
    push.radius = 0.02f;
    ExplosionSettings explosion;
    explosion.centre = {0.55f, 0.35f, 0.1f};
    explosion.radius = 1.5f;
    explosion.impulse = 90;
    const Vec3 points[] = {{-0.7f, 0.2f, 0}, {-0.5f, 0.26f, 0}, {-0.2f, 0.2f, 0}};
    CutSettings cut;
    cut.points = points;
    cut.point_count = 3;
    if (frame == 2) {
        expect_done(world.push_impact(bodies[0], push));
        push.place = {0.08f, 0.1f, 0};
        push.normal = {-1, 0, 0};
        expect_done(world.push_impact(bodies[0], push));
        expect_done(world.cut({}, cut));
    }
    if (frame == 4) {
        expect_done(world.explode(explosion));
        expect_done(world.push_impact(bodies[0], push));
        cut.point_count = 0;
        cut.place = {0, 0.12f, 0};
        cut.normal = {0, 0.8f, 0.6f};
        expect_done(world.cut(bodies[0], cut));
    }
    if (frame == 40) {
        explosion.centre = {0.1f, 0.05f, 0.1f};
        expect_done(world.explode(explosion));
    }
    if (frame == 41) expect_done(world.shift_origin({2, 0, 1}));
}

constexpr int kFrames = 60;

std::vector<uint64_t> hashes_of(uint32_t threads) {
    World world = make_world(sliced_settings(threads));
    furnish(world);
    std::vector<uint64_t> hashes;
    for (int frame = 0; frame < kFrames; ++frame) {
        ask(world, frame);
        world.step();
        hashes.push_back(world.hash());
    }
    EXPECT_GT(shells_of(world).size(), 12u);
    EXPECT_EQ(world.contents().data.counts.dropped, 0u);
    EXPECT_EQ(world.contents().data.told.of<FaultEvent>().size(), 0u);
    return hashes;
}

TEST(BlowsBytes, AreTheSameOnOneTwoAndThreeThreads) {
    const std::vector<uint64_t> one = hashes_of(1);
    EXPECT_EQ(one, hashes_of(2));
    EXPECT_EQ(one, hashes_of(3));
}

TEST(BlowsBytes, AWorldThatIsSavedWithBlowsWaitingGoesOnAsTheOneThatLoads) {
    uint32_t waiting = 0;
    for (const int saved : test::few_or_all<std::vector<int>>({2, 4, 6, 12}, {2, 3, 4, 5, 6, 9, 12, 40})) {
        World world = make_world(sliced_settings(1));
        furnish(world);
        for (int frame = 0; frame < saved; ++frame) {
            ask(world, frame);
            world.step();
        }
        ask(world, saved);  // queued, not yet taken
        waiting += state_of(world).blows.size();
        const Result<std::vector<uint8_t>> bytes = world.snapshot();
        ASSERT_TRUE(bytes.ok()) << bytes.error();
        World twin = make_world(sliced_settings(2));
        expect_done(twin.restore(bytes->data(), bytes->size()));
        ASSERT_EQ(world.hash(), twin.hash()) << "saved before step " << saved;
        for (int frame = saved; frame < kFrames; ++frame) {
            if (frame > saved) ask(world, frame), ask(twin, frame);
            world.step(), twin.step();
            ASSERT_EQ(world.hash(), twin.hash()) << "saved before step " << saved << ", step " << frame << ": "
                                                 << state_of(world).first_difference(state_of(twin));
        }
    }
    EXPECT_GT(waiting, test::few_or_all(4u, 8u));
}

TEST(BlowsBytes, AReplayGivesEveryHashOnAnyNumberOfThreads) {
    const std::string path = (std::filesystem::temp_directory_path() / "cullet_blows.crec").string();
    {
        World world = make_world(sliced_settings(1));
        expect_done(world.start_recording(path));
        furnish(world);
        for (int frame = 0; frame < kFrames; ++frame) {
            ask(world, frame);
            EXPECT_FALSE(world.explode({}).ok());  // refused here and there
            world.step();
        }
        expect_done(world.stop_recording());
    }
    ReplaySettings settings;
    settings.threads = {1, 2, 3};
    const Result<ReplayReport> report = replay(path, settings);
    ASSERT_TRUE(report.ok()) << report.error();
    EXPECT_EQ(report->frames, static_cast<uint64_t>(kFrames));
    EXPECT_EQ(report->difference, "");
    EXPECT_EQ(report->damage, "");
    std::filesystem::remove(path);
    std::filesystem::remove_all(path + ".models");
}

TEST(BlowsBytes, AWorldWithoutBlowsHasTheHashThatItHadBeforeThereWereAny) {
    State state;
    const uint64_t empty = state.hash();
    state.blows.append(1);
    EXPECT_NE(state.hash(), empty);
    state.blows.truncate(0);
    EXPECT_EQ(state.hash(), empty);
}

// A host is told of pushes, births and shapes as of contacts'.
TEST(BlowsBytes, AHostsBodiesAreStruckToo) {
    World world = std::move(World::create_hosted(small_settings())).value();
    const BodyId vase = world.spawn(world.add_model(small_vase()).value()).value();
    SphereSettings ball = ball_at({0.3f, 0.15f, 0}, 1, 0);
    const BodyId id = world.add_sphere(ball).value();
    const HostBody rows[] = {{vase, {}, {}}, {id, ball.pose, {}}};
    ASSERT_TRUE(world.step({rows, 2, nullptr, 0}).ok());
    ExplosionSettings explosion;
    explosion.centre = {0.15f, 0.15f, 0.15f};
    explosion.impulse = 150;
    expect_done(world.explode(explosion));
    CutSettings cut;
    cut.place = {0, 0.05f, 0};
    expect_done(world.cut(vase, cut));
    uint32_t born = 0, reshaped = 0;
    bool is_ball_moved = false;
    for (int frame = 0; frame < 20; ++frame) {
        ASSERT_TRUE(world.step({nullptr, 0, nullptr, 0}).ok());
        born += world.host_changes().born.count;
        reshaped += world.host_changes().reshaped.count;
        for (const HostMotion& moved : world.host_changes().moved)
            is_ball_moved = is_ball_moved || (moved.body == id && length(moved.motion.velocity) > 0);
    }
    EXPECT_TRUE(is_ball_moved);
    EXPECT_GT(born, 3u);
    EXPECT_GT(reshaped, 0u);
}

}  // namespace
}  // namespace cullet::test
