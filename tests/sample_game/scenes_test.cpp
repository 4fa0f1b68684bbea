// Every scene: the same bytes on any number of threads, no memory asked for, no mass lost.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <thread>

#include "sample_game/allocations.hpp"
#include "sample_game/drawn_meshes.hpp"
#include "sample_game/run_scene.hpp"
#include "systems/world_contents.hpp"
#include "tests/support/scene_hashes.hpp"

namespace cullet {
namespace {

/// As CULLET_SCENE_FRAMES says, or else this many.
uint32_t frames_to_play(uint32_t if_not_said) {
    const char* text = std::getenv("CULLET_SCENE_FRAMES");
    const int wanted = text ? std::atoi(text) : 0;
    return wanted > 0 ? static_cast<uint32_t>(wanted) : if_not_said;
}
const uint32_t kFrames = frames_to_play(120);
/// Those that are compared hash by hash, in seven plays: in 40 of pile a dozen vases break.
uint32_t hashed_frames_of(const Scene& scene) {
    return scene.name == "pile" ? frames_to_play(40) : kFrames;
}

/// A scene's plan, cooked once for all tests of it.
const ScenePlan& plan_of(const Scene& scene) {
    static std::map<std::string, ScenePlan> plans;
    if (const auto found = plans.find(scene.name); found != plans.end()) return found->second;
    RunOptions options;
    options.scene = scene.name;
    options.threads = 2;
    return plans[scene.name] = plan_scene(scene, options);
}

class EveryScene : public testing::TestWithParam<Scene> {};

/// Of each frame.
std::vector<uint64_t> hashes_of(const Scene& scene, uint32_t threads, const Host& host = {}) {
    ScenePlan plan = plan_of(scene);
    plan.threads = threads;
    return test::hashes_of(plan, hashed_frames_of(scene), host);
}
/// On one thread, played once for all tests of the scene.
const std::vector<uint64_t>& hashes_alone(const Scene& scene) {
    static std::map<std::string, std::vector<uint64_t>> hashes;
    std::vector<uint64_t>& found = hashes[scene.name];
    if (found.empty()) found = hashes_of(scene, 1);
    return found;
}
using test::difference;

/// Runs jobs from the last to the first, or in an order that changes with each call.
struct OddJobs {
    bool is_random = false;
    uint64_t calls = 0;
    static void run(void* user, uint32_t count, void (*job)(void* context, uint32_t index), void* context) {
        if (count == 0) return;
        auto& self = *static_cast<OddJobs*>(user);
        // An odd stride that shares no factor with count visits every index once.
        uint64_t stride = 1;
        if (self.is_random)
            for (stride = (self.calls * 2654435761u) % count + 1; std::gcd<uint64_t>(stride, count) != 1;) ++stride;
        const uint64_t start = self.is_random ? self.calls++ * 40503u : 0;
        for (uint32_t i = count; i-- > 0;) job(context, static_cast<uint32_t>((start + i * stride) % count));
    }
};

// Two worlds at once on one and two threads: see below.
TEST_P(EveryScene, HashesAreEqualOnOneThreeAndEightThreads) {
    const Scene& scene = GetParam();
    const std::vector<uint64_t>& one = hashes_alone(scene);
    ASSERT_EQ(one.size(), hashed_frames_of(scene));
    EXPECT_NE(one.front(), one.back());
    for (const uint32_t threads : {3u, 8u})
        EXPECT_EQ(difference(one, hashes_of(scene, threads)), "") << threads << " threads";
    for (const bool is_random : {false, true}) {
        OddJobs jobs{is_random};
        Host host;
        host.jobs.user = &jobs;
        host.jobs.worker_count = [](void*) { return 4u; };
        host.jobs.parallel_for = &OddJobs::run;
        EXPECT_EQ(difference(one, hashes_of(scene, 1, host)), "")
            << (is_random ? "shuffled" : "backward") << " host jobs";
    }
}

TEST_P(EveryScene, TwoWorldsSteppedOnOneAndTwoThreadsAtOnceDoNotMeet) {
    const Scene& scene = GetParam();
    const std::vector<uint64_t>& alone = hashes_alone(scene);
    plan_of(scene);  // cooked before two threads ask for it
    std::vector<uint64_t> beside;
    std::thread other([&] { beside = hashes_of(scene, 2); });
    const std::vector<uint64_t> here = hashes_of(scene, 1);
    other.join();
    EXPECT_EQ(difference(alone, here), "");
    EXPECT_EQ(difference(alone, beside), "");
}

uint32_t soft_and_awake(const World& world) {
    const SoftBodies& soft = world.contents().data.state.soft_bodies;
    uint32_t count = 0;
    for (uint32_t s = 0; s < soft.size(); ++s) count += soft.is_used[s] && soft.is_awake[s];
    return count;
}

/// Vertices that were split, of all soft bodies.
uint64_t tears(const World& world) {
    const SoftBodies& soft = world.contents().data.state.soft_bodies;
    uint64_t count = 0;
    for (uint32_t s = 0; s < soft.size(); ++s) count += soft.is_used[s] ? soft.tear_count[s] : 0;
    return count;
}

TEST_P(EveryScene, SomethingBreaksOrGivesWayNothingIsLostAndNoMemoryIsAskedFor) {
    const ScenePlan& plan = plan_of(GetParam());
    Result<GameWorld> game = GameWorld::create(plan);
    ASSERT_TRUE(game.ok()) << game.error();
    AllocationCounts counts;
    DrawnMeshes drawn;
    uint32_t frames_soft = 0;
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
        game->before_step();
        if (frame >= kFirstCountedFrame) start_counting_allocations();
        game->step();
        if (frame >= kFirstCountedFrame) {
            const AllocationCounts found = stop_counting_allocations();
            counts.ours += found.ours;
            counts.rigid += found.rigid;
        }
        game->after_step();
        frames_soft += soft_and_awake(game->world()) > 0;
        ASSERT_EQ(game->world().contents().data.state.validate(), "") << "frame " << frame;
        ASSERT_EQ(drawn.check_changed(game->world()), "") << "frame " << frame;
    }
    EXPECT_GE(drawn.checked(), game->sums().born);
    const WorldData& data = game->world().contents().data;
    std::printf(
        "%s: frames made at most %.3g J, %.2f of what is allowed, in frame %llu; rigid steps made %.3g J in all\n",
        std::string(GetParam().name).c_str(), data.energy.most_gain, data.energy.most_share,
        static_cast<unsigned long long>(data.energy.most_frame), data.rigid->work().sum());
    EXPECT_LE(data.energy.most_share, 1);  // measured in Checked and Debug builds
    EXPECT_EQ(counts.ours, 0u);
    EXPECT_EQ(counts.rigid, 0u);
    EXPECT_GT(game->sums().born + frames_soft, 0u);
    if (std::string(GetParam().name) == "tear") {
        EXPECT_GT(tears(game->world()), 10u);
    }
    EXPECT_EQ(game->sums().events["fault"], 0u) << (game->sums().faults.empty() ? "" : game->sums().faults[0]);
    // A house that is hit by many explosions runs out of the room that its mesh has for cracks, and says so.
    EXPECT_LE(game->sums().events["refused"], std::string(GetParam().name) == "demolition" ? 5u : 0u);
    const Matter matter = measure_matter(game->world());
    EXPECT_NEAR(matter.mass, game->mass_put_in(), 1e-6 * game->mass_put_in());
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(scenes().begin(), scenes().end()),
                         [](const auto& scene) { return scene.param.name; });

TEST(Scenes, TheBudgetOfDropIsRaisedUntilAHitFitsAHold) {
    const Scene& drop = *find_scene("drop");
    const Result<GameWorld> game = GameWorld::create(plan_of(drop));
    ASSERT_TRUE(game.ok()) << game.error();
    const Settings settings = game->stage().settings();
    const double frames = std::floor(settings.hold_seconds / settings.step_seconds + 1e-3f);
    EXPECT_GE(static_cast<double>(settings.units_a_frame) * frames,
              static_cast<double>(game->stage().models[0].model.report().units_of_a_hit));
}

TEST(Scenes, AnInfiniteStrengthNeverBreaks) {
    RunOptions options;
    options.scene = "pane";
    options.set = {"scene.strength_scale=inf"};
    const Scene& pane = *find_scene("pane");
    Result<GameWorld> game = GameWorld::create(plan_scene(pane, options));
    ASSERT_TRUE(game.ok());
    for (uint32_t frame = 0; frame < 60; ++frame) test::play_frame(*game);
    EXPECT_EQ(game->sums().born, 0u);
    EXPECT_EQ(game->sums().events["crack_started"], 0u);
}

}  // namespace
}  // namespace cullet
