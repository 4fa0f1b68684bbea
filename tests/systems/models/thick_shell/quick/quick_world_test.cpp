// Bodies that break quickly, in a world: the same bytes on any number of threads, from snapshots and recordings; mass
// and momentum at the hand-off; pieces that break again; refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "components/state.hpp"
#include "sample_game/allocations.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "tests/support/large_hits.hpp"
#include "tests/support/random_hits.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

QuickSettings layered(uint32_t layers) {
    QuickSettings quick;
    quick.layers = layers;
    return quick;
}

struct Kind {
    const char* name;
    const Model* model;
    QuickSettings quick;
};

/// A quick body in mid-air, hit by a ball.
Breakage quick_and_ball(const Settings& settings, const Model& model, const QuickSettings& quick, float speed,
                        float mass = 0.3f) {
    Breakage b{make_world(settings), {}, {}};
    const ModelId id = b.world.add_model(model).value();
    SpawnSettings spawn;
    spawn.thick_shell.fracture = FractureMode::Quick;
    spawn.thick_shell.quick = quick;
    spawn.user_data = 42;
    b.body = b.world.spawn(id, spawn).value();
    b.ball = b.world.add_sphere(ball_at({0.01f, 0.13f, 0}, mass, speed)).value();
    return b;
}

Settings threads_of(uint32_t threads) {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    settings.threads = threads;
    return settings;
}

constexpr float kSpeed = 40;  // m/s

TEST(QuickWorld, ARunWithoutRoomForMoreSplitsSaysSoAndIsCounted) {
    for (const bool is_full : {false, true}) {
        Breakage b = quick_and_ball(threads_of(1), small_vase(), {}, kSpeed);
        State& state = state_of(b.world);
        // As if its shell had no row left.
        after_each_system(b.world, [&](const std::string& system) {
            for (uint32_t t = 0; system == "start_regions" && t < state.quick_runs.size(); ++t)
                if (state.quick_runs.is_quick[t]) state.tasks.lacks_room[t] = is_full;
        });
        uint32_t events = 0;
        for (uint32_t frame = 0; frame < 30; ++frame) {
            b.world.step();
            for (const RefusedEvent& e : b.world.events().refused) {
                EXPECT_STREQ(e.setting, "longest_edge");
                EXPECT_EQ(e.body.index, b.body.index);
                ++events;
            }
        }
        EXPECT_EQ(b.world.contents().data.counts.cuts_refused, events);
        EXPECT_EQ(events > 0, is_full);
        EXPECT_EQ(shells_of(b.world).size() > 1, !is_full);
    }
}

TEST(QuickWorld, HashesAreEqualOnOneTwoThreeAndEightThreads) {
    for (const uint32_t layers : {1u, 2u}) {
        std::vector<uint64_t> first;
        for (const uint32_t threads : {1u, 2u, 3u, 8u}) {
            Breakage b = quick_and_ball(threads_of(threads), small_vase(), layered(layers), kSpeed);
            const std::vector<uint64_t> hashes = hashes_of(b.world, 40);
            if (threads == 1) {
                first = hashes;
                EXPECT_GT(shells_of(b.world).size(), 1u) << layers << " layers: nothing came off";
                continue;
            }
            EXPECT_EQ(hashes, first) << threads << " threads, " << layers << " layers";
        }
    }
}

TEST(QuickWorld, AHitIsOverInTheFrameOfTheTouch) {
    Breakage b = quick_and_ball(small_settings(), small_vase(), {}, kSpeed);
    uint32_t frames_with_tasks = 0;
    for (int frame = 0; frame < 40; ++frame) {
        b.world.step();
        frames_with_tasks += open_tasks(b.world) > 0;
    }
    EXPECT_EQ(frames_with_tasks, 0u);
    EXPECT_GT(b.world.contents().data.counts.opened, 0u);
    EXPECT_EQ(b.world.contents().data.counts.late, 0u);
}

// What a hand-off takes cannot be cut into parts, so that two in one frame were the worst of it.
TEST(QuickWorld, WhereUnitsAreFewTwoHitsAreNotHandedOnInOneFrame) {
    for (const bool are_few : {false, true}) {
        Settings settings = small_settings();
        settings.units_a_frame = are_few ? 500'000 : 100'000'000;
        Breakage b = quick_and_ball(settings, small_vase(), {}, kSpeed);
        SpawnSettings spawn;
        spawn.thick_shell.fracture = FractureMode::Quick, spawn.pose.position = {5, 0, 0};
        ASSERT_TRUE(b.world.spawn(b.world.add_model(small_vase()).value(), spawn).ok());
        SphereSettings ball = ball_at({0.01f, 0.13f, 0}, 0.3f, kSpeed);
        ball.pose.position += spawn.pose.position;
        ASSERT_TRUE(b.world.add_sphere(ball).ok());
        uint32_t most = 0;
        after_each_system(b.world, [&](const std::string& system) {
            if (system == "settle_tasks")
                most = std::max<uint32_t>(most, b.world.contents().data.between.of<TaskEnded>().size());
        });
        const DamageCounts& counts = b.world.contents().data.counts;
        for (int frame = 0; frame < 60 && counts.broke < 2; ++frame) b.world.step();
        EXPECT_GE(counts.broke, 2u) << "none starves";
        EXPECT_EQ(most, are_few ? 1u : 2u);
    }
}

TEST(QuickWorld, MassAndMomentumAreKeptWhereItBreaks) {
    for (const uint32_t layers : {1u, 2u}) {
        Breakage b = quick_and_ball(small_settings(), small_vase(), layered(layers), kSpeed);
        expect_matter_is_kept(b, 60);
    }
}

struct QuickOutcome {
    uint64_t cuts;
    size_t pieces;
};
QuickOutcome outcome_of(const QuickSettings& quick) {
    Breakage b = quick_and_ball(small_settings(), small_vase(), quick, kSpeed);
    // The first break alone: what its pieces do to each other afterwards depends on where they fly.
    for (int frame = 0; frame < 10 && b.world.contents().data.counts.broke == 0; ++frame) b.world.step();
    return {b.world.contents().data.counts.cuts, shells_of(b.world).size()};
}

TEST(QuickWorld, EachOptionActs) {
    const QuickOutcome plain = outcome_of({});
    EXPECT_GT(plain.pieces, 1u);
    QuickSettings quick;
    quick.crack_length = 0;  // what starts does not run on
    EXPECT_LT(3 * outcome_of(quick).cuts, 2 * plain.cuts);
    quick = {};
    quick.crack_frequency = 64;  // large fracture's is 1
    EXPECT_GT(outcome_of(quick).cuts, plain.cuts);
    quick = {};
    quick.steps = 8;
    EXPECT_LT(outcome_of(quick).cuts, plain.cuts);
    quick = {};
    quick.strain_limit = 0.9f;
    EXPECT_EQ(outcome_of(quick).cuts, 0u);
    quick = {};
    quick.bump_angle = 0;  // another way, of about the same length
    EXPECT_NE(outcome_of(quick).cuts, plain.cuts);
}

TEST(QuickWorld, PiecesAreQuickAndBreakAgain) {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    Breakage b = quick_and_ball(settings, small_vase(), {}, kSpeed);
    for (int frame = 0; frame < 20; ++frame) b.world.step();
    const State& state = state_of(b.world);
    const std::vector<BodyId> pieces = shells_of(b.world);
    ASSERT_GT(pieces.size(), 1u);
    for (const BodyId id : pieces) EXPECT_TRUE(is_quick_body(state, Row<Bodies>(id.index)));
    // The largest is hit again.
    const BodyId largest = *std::max_element(pieces.begin(), pieces.end(), [&](BodyId a, BodyId c) {
        return b.world.mass(a).value() < b.world.mass(c).value();
    });
    const Pose pose = b.world.pose(largest).value();
    const Row<Structures> shell = state.bodies.structure[largest.index];
    PushSettings push;
    const Range vertices = state.shells.vertices[state.shell_of(shell)];
    for (uint32_t v = vertices.first; v < vertices.first + vertices.count; ++v)
        if (state.vertices.element[v] != kNone) {
            push.place = to_world(pose, state.vertices.rest[v]);
            push.normal = rotate(pose.orientation, state.vertices.inward[v]);
        }
    push.approach_speed = 2 * kSpeed, push.mass = 1, push.radius = 0.03f;
    const uint64_t broke = b.world.contents().data.counts.broke;
    ASSERT_TRUE(b.world.push_impact(largest, push).ok());
    for (int frame = 0; frame < 10; ++frame) b.world.step();
    EXPECT_GT(b.world.contents().data.counts.broke, broke);
}

TEST(QuickWorld, ASnapshotBetweenTwoFramesOfAHitGoesOnAsItWas) {
    Settings settings = threads_of(1);
    settings.units_a_frame = 100'000;  // a few steps a frame
    for (const uint32_t layers : {1u, 2u}) {
        Breakage b = quick_and_ball(settings, small_vase(), layered(layers), kSpeed);
        for (int frame = 0; frame < 60 && open_tasks(b.world) == 0; ++frame) b.world.step();
        for (int frame = 0; frame < 4; ++frame) b.world.step();
        ASSERT_GT(open_tasks(b.world), 0u);
        SCOPED_TRACE(layers);
        expect_goes_on(b.world, settings, 60);
        EXPECT_GT(shells_of(b.world).size(), 1u);
    }
}

TEST(QuickWorld, FramesDoNotAllocate) {
    Breakage b = quick_and_ball(threads_of(1), small_vase(), layered(2), kSpeed);
    start_counting_allocations();
    for (int frame = 0; frame < 40; ++frame) b.world.step();
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
    EXPECT_GT(shells_of(b.world).size(), 1u);
}

TEST(QuickWorld, SettingsOutOfRangeAreRefusedWithASentence) {
    World world = make_world(small_settings());
    const ModelId id = world.add_model(small_vase()).value();
    const auto refused = [&](auto change, const std::string& name) {
        SpawnSettings spawn;
        spawn.thick_shell.fracture = FractureMode::Quick;
        change(spawn.thick_shell.quick);
        const Result<BodyId> body = world.spawn(id, spawn);
        ASSERT_FALSE(body.ok()) << name;
        EXPECT_NE(body.error().find("quick." + name), std::string::npos) << body.error();
    };
    refused([](QuickSettings& q) { q.layers = 3; }, "layers");
    refused([](QuickSettings& q) { q.layers = 0; }, "layers");
    refused([](QuickSettings& q) { q.steps = 7; }, "steps");
    refused([](QuickSettings& q) { q.steps = 101; }, "steps");
    refused([](QuickSettings& q) { q.crack_frequency = 1001; }, "crack_frequency");
    refused([](QuickSettings& q) { q.strain_limit = 2; }, "strain_limit");
    refused([](QuickSettings& q) { q.strain_limit = std::nanf(""); }, "strain_limit");
    refused([](QuickSettings& q) { q.compression_limit = 0.5f; }, "compression_limit");
    refused([](QuickSettings& q) { q.crack_length = -1; }, "crack_length");
    refused([](QuickSettings& q) { q.bump_angle = 31; }, "bump_angle");
}

/// Whether a heavy striker cracks a loose wall of brick along the sheet, at the vertex nearest to `place`; `times` the
/// speed of the first crack.
bool cracks_along_the_sheet(uint32_t layers, Vec3 place, float times) {
    World world = make_world(small_settings());
    SpawnSettings spawn;
    spawn.thick_shell.fracture = FractureMode::Quick, spawn.thick_shell.quick = layered(layers);
    const BodyId body = world.spawn(world.add_model(small_wall()).value(), spawn).value();
    PushSettings push;
    push.place = place, push.normal = {0.6f, -0.8f, 0}, push.mass = 60;
    push.approach_speed = times * small_wall().report().first_crack_speed;
    EXPECT_TRUE(world.push_impact(body, push).ok());
    for (int frame = 0; frame < 3; ++frame) world.step();
    EXPECT_GT(world.contents().data.counts.opened, 0u);
    const State& state = state_of(world);
    return shells_of(world).size() > 1 || state.structures.has_cracks[state.bodies.structure[body.index]] != 0;
}

// With the limit of blows on a face a sheet of one layer cracked at a fortieth of the speed: walls went on breaking
// under their own pieces.
TEST(QuickWorld, ABlowAlongASheetCracksItNoSoonerThanAFallDoes) {
    for (const uint32_t layers : {1u, 2u}) {
        for (const Vec3 place : {Vec3{0, 0.45f, 0}, Vec3{-0.3f, 0.6f, 0}, Vec3{0.1f, 0.9f, 0}})
            EXPECT_FALSE(cracks_along_the_sheet(layers, place, 0.7f)) << layers << " layers, y " << place.y;
        EXPECT_TRUE(cracks_along_the_sheet(layers, {0.6f, 0.9f, 0}, 4)) << layers << " layers, at a corner";
    }
}

TEST(QuickWorld, AHiddenBodyInAReusedRowIsNotQuick) {
    World world = make_world(small_settings());
    const ModelId id = world.add_model(small_vase()).value();
    SpawnSettings spawn;
    spawn.thick_shell.fracture = FractureMode::Quick;
    const BodyId quick = world.spawn(id, spawn).value();
    EXPECT_TRUE(is_quick_body(state_of(world), Row<Bodies>(quick.index)));
    ASSERT_TRUE(world.remove(quick).ok());
    const BodyId hidden = world.spawn(id).value();
    ASSERT_EQ(hidden.index, quick.index);
    EXPECT_FALSE(is_quick_body(state_of(world), Row<Bodies>(hidden.index)));
}

}  // namespace
}  // namespace cullet::test
