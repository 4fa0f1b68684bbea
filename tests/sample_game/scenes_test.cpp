// Every scene: the same bytes on any number of threads and in every build, no memory asked for, no mass lost, drawn
// closed, and before its camera.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numeric>
#include <thread>

#include "engine/hash.hpp"
#include "sample_game/allocations.hpp"
#include "sample_game/drawn_meshes.hpp"
#include "sample_game/run_scene.hpp"
#include "systems/world_contents.hpp"
#include "tests/support/camera_view.hpp"
#include "tests/support/drawn_look.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/places.hpp"
#include "tests/support/scene_hashes.hpp"

namespace cullet {
namespace {

using test::few_or_all;

/// As CULLET_SCENE_FRAMES says, or else this many.
uint32_t frames_to_play(uint32_t if_not_said) {
    const char* text = std::getenv("CULLET_SCENE_FRAMES");
    const int wanted = text ? std::atoi(text) : 0;
    return wanted > 0 ? static_cast<uint32_t>(wanted) : if_not_said;
}
/// A second of these costs as much as ten of another: the pile is many bodies, a car's rows and drawing are large.
bool is_large(const Scene& scene) {
    return scene.name == "pile" || scene.name == "car";
}
/// Those that are compared hash by hash: everything that breaks by a blow has broken by then, of pile a dozen vases.
uint32_t hashed_frames_of(const Scene& scene) {
    return frames_to_play(is_large(scene) ? few_or_all(30u, 120u) : few_or_all(60u, 120u));
}
/// Those of the play that is looked at. What breaks lies still at the end of 240, but for the pile and the street,
/// which go on; what comes later in the pile lies on what is there. The vase still flies apart before its camera in
/// 120.
uint32_t frames_of(const Scene& scene) {
    const uint32_t few = scene.name == "vase" ? 240 : 120;
    return frames_to_play(is_large(scene) ? few_or_all(40u, 120u) : few_or_all(few, 240u));
}

/// What is drawn of a large scene takes longer to look at than to play.
bool looks_at(const Scene& scene, uint32_t frame) {
    return !is_large(scene) || frame % few_or_all(4u, 1u) == 0;
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

/// What is seen of a scene on one thread. It is played once for all tests that ask about it.
struct Alone {
    std::string error;                             // why there was no world
    std::vector<uint64_t> hashes;                  // of each frame
    std::string invalid, wrong_mesh, wrong_drawn;  // the first of each, with its frame
    AllocationCounts allocated;                    // within steps, from kFirstCountedFrame on
    uint64_t born = 0, faults = 0, refused = 0, tears = 0, meshes = 0, looked_at = 0, with_cracks = 0;
    std::string first_fault;
    uint32_t frames_soft = 0;
    uint64_t dented = 0;                               // bodies of metal, each time
    double mass_put_in = 0, mass = 0, most_share = 0;  // kg, kg, of the energy that a frame may make
    std::vector<std::pair<uint32_t, test::Seen>>
        seen;  // by its camera, in the frames of its contact sheet and the last
};

uint32_t soft_and_awake(const World& world) {
    const SoftBodies& soft = world.contents().data.state.soft_bodies;
    uint32_t count = 0;
    for (uint32_t s = 0; s < soft.size(); ++s) count += soft.is_used[s] && soft.is_awake[s];
    return count;
}

/// Bodies of metal that an impact moved vertices of in the last frames.
uint32_t dents_of(const World& world) {
    const MetalImpacts& impacts = world.contents().data.state.metal_impacts;
    uint32_t count = 0;
    for (uint32_t b = 0; b < impacts.size(); ++b) count += impacts.has_shape[b];
    return count;
}

/// Vertices that were split, of all soft bodies.
uint64_t tears(const World& world) {
    const SoftBodies& soft = world.contents().data.state.soft_bodies;
    uint64_t count = 0;
    for (uint32_t s = 0; s < soft.size(); ++s) count += soft.is_used[s] ? soft.tear_count[s] : 0;
    return count;
}

void step_counted(GameWorld& game, bool counts, AllocationCounts& sum) {
    game.before_step();
    if (counts) start_counting_allocations();
    game.step();
    if (counts) {
        const AllocationCounts found = stop_counting_allocations();
        sum.ours += found.ours, sum.rigid += found.rigid;
    }
    game.after_step();
}

void keep_first(std::string& first, const std::string& found, uint32_t frame) {
    if (first.empty() && !found.empty()) first = "frame " + std::to_string(frame) + ": " + found;
}

void fill_end(GameWorld& game, Alone& out) {
    const WorldData& data = game.world().contents().data;
    std::printf(
        "%s: frames made at most %.3g J, %.2f of what is allowed, in frame %llu; rigid steps made %.3g J in all\n",
        game.stage().plan.scene.name.c_str(), data.energy.most_gain, data.energy.most_share,
        static_cast<unsigned long long>(data.energy.most_frame), data.rigid->work().sum());
    out.most_share = data.energy.most_share;
    out.born = game.sums().born;
    out.faults = game.sums().events["fault"], out.refused = game.sums().events["refused"];
    if (!game.sums().faults.empty()) out.first_fault = game.sums().faults[0];
    out.tears = tears(game.world());
    out.mass_put_in = game.mass_put_in(), out.mass = measure_matter(game.world()).mass;
}

Alone play_alone(const Scene& scene) {
    Alone out;
    ScenePlan plan = plan_of(scene);
    plan.threads = 1;
    Result<GameWorld> game = GameWorld::create(plan);
    if (!game.ok()) return out.error = game.error(), out;
    const Story story = read_story(plan).value();
    const auto& shown = story.sheet_frames;
    const uint32_t frames = frames_of(scene), last = std::min(frames, frame_count(story, {}));
    DrawnMeshes meshes;
    test::DrawnLook drawn;
    keep_first(out.wrong_drawn, drawn.at(game->world()), 0);
    for (uint32_t frame = 1; frame <= frames; ++frame) {
        step_counted(*game, frame > kFirstCountedFrame, out.allocated);
        if (frame <= hashed_frames_of(scene)) out.hashes.push_back(game->world().hash());
        out.frames_soft += soft_and_awake(game->world()) > 0;
        out.dented += dents_of(game->world());
        keep_first(out.invalid, game->world().contents().data.state.validate(), frame);
        if (looks_at(scene, frame)) {
            keep_first(out.wrong_mesh, meshes.check_changed(game->world()), frame);
            keep_first(out.wrong_drawn, drawn.at(game->world()), frame);
        }
        if (frame == last || (frame < last && std::find(shown.begin(), shown.end(), frame) != shown.end()))
            out.seen.emplace_back(frame, test::seen_of(*game));
    }
    out.meshes = meshes.checked(), out.looked_at = drawn.looked_at(), out.with_cracks = drawn.with_cracks();
    fill_end(*game, out);
    return out;
}

const Alone& alone(const Scene& scene) {
    static std::map<std::string, Alone> plays;
    if (const auto found = plays.find(scene.name); found != plays.end()) return found->second;
    return plays[scene.name] = play_alone(scene);
}
using test::difference;

/// As a report has it.
uint64_t chain_of(const std::vector<uint64_t>& hashes) {
    uint64_t chain = 0;
    for (const uint64_t hash : hashes) chain = hash_bytes(&hash, sizeof hash, chain);
    return chain;
}

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

// Two and three threads: see below. The usual run has one order of jobs, and none of large scenes.
TEST_P(EveryScene, HashesAreEqualOnAnyNumberOfThreads) {
    const Scene& scene = GetParam();
    const std::vector<uint64_t>& one = alone(scene).hashes;
    ASSERT_EQ(one.size(), hashed_frames_of(scene)) << alone(scene).error;
    EXPECT_NE(one.front(), one.back());
    if (test::plays_all()) {
        EXPECT_EQ(difference(one, hashes_of(scene, 8)), "") << "8 threads";
    }
    const std::vector<bool> few = is_large(scene) ? std::vector<bool>{} : std::vector<bool>{true};
    for (const bool is_random : few_or_all<std::vector<bool>>(few, {true, false})) {
        OddJobs jobs{is_random};
        Host host;
        host.jobs.user = &jobs;
        host.jobs.worker_count = [](void*) { return 4u; };
        host.jobs.parallel_for = &OddJobs::run;
        EXPECT_EQ(difference(one, hashes_of(scene, 1, host)), "")
            << (is_random ? "shuffled" : "backward") << " host jobs";
    }
}

TEST_P(EveryScene, TwoWorldsSteppedOnTwoAndThreeThreadsAtOnceDoNotMeet) {
    const Scene& scene = GetParam();
    const std::vector<uint64_t>& one = alone(scene).hashes;
    plan_of(scene);  // cooked before two threads ask for it
    std::vector<uint64_t> beside;
    std::thread other([&] { beside = hashes_of(scene, 2); });
    const std::vector<uint64_t> here = hashes_of(scene, 3);
    other.join();
    EXPECT_EQ(difference(one, here), "");
    EXPECT_EQ(difference(one, beside), "");
}

/// What every build has to give: of each scene a number of frames, and the chain of their hashes.
const char* const kKnownChains = "/tests/sample_game/scene_chains.txt";

struct KnownChain {
    size_t frames = 0;
    std::string chain;
};
std::map<std::string, KnownChain> known_chains() {
    std::map<std::string, KnownChain> known;
    std::ifstream file(source_folder() + kKnownChains);
    std::string scene;
    KnownChain next;
    while (file >> scene >> next.frames >> next.chain) known[scene] = next;
    return known;
}

std::string chain_after(const std::vector<uint64_t>& hashes, size_t frames) {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx",
                  static_cast<unsigned long long>(chain_of({hashes.begin(), hashes.begin() + frames})));
    return digits;
}

/// CULLET_WRITE_CHAINS=1 writes the list anew, for a change that is meant to change what happens.
void write_chain(const std::string& scene, const KnownChain& chain) {
    std::map<std::string, KnownChain> known = known_chains();
    known[scene] = chain;
    std::ofstream file(source_folder() + kKnownChains);
    for (const auto& [name, of] : known) file << name << ' ' << of.frames << ' ' << of.chain << '\n';
}

TEST_P(EveryScene, GivesInThisBuildTheHashesThatEveryBuildGives) {
    const std::vector<uint64_t>& own = alone(GetParam()).hashes;
    if (std::getenv("CULLET_WRITE_CHAINS")) write_chain(GetParam().name, {own.size(), chain_after(own, own.size())});
    const std::map<std::string, KnownChain> known = known_chains();
    const auto of = known.find(GetParam().name);
    ASSERT_NE(of, known.end()) << "no line of" << kKnownChains << "; CULLET_WRITE_CHAINS=1 writes it";
    if (std::getenv("CULLET_SCENE_FRAMES") && own.size() < of->second.frames)
        GTEST_SKIP() << "CULLET_SCENE_FRAMES plays fewer frames than the list is of";
    ASSERT_GE(own.size(), of->second.frames);
    EXPECT_EQ(chain_after(own, of->second.frames), of->second.chain)
        << "a change that is meant to change what happens writes the list anew with CULLET_WRITE_CHAINS=1";
}

TEST_P(EveryScene, SomethingBreaksOrGivesWayNothingIsLostAndNoMemoryIsAskedFor) {
    const Alone& play = alone(GetParam());
    ASSERT_EQ(play.error, "");
    EXPECT_EQ(play.invalid, "");
    EXPECT_LE(play.most_share, 1);  // measured in Checked and Debug builds
    EXPECT_EQ(play.allocated.ours, 0u);
    EXPECT_EQ(play.allocated.rigid, 0u);
    EXPECT_GT(play.born + play.frames_soft + play.dented, 0u);
    if (GetParam().name == "tear") {
        EXPECT_GT(play.tears, 10u);
    }
    EXPECT_EQ(play.faults, 0u) << play.first_fault;
    // A house that is hit by many explosions runs out of the room that its mesh has for cracks, and says so.
    EXPECT_LE(play.refused, GetParam().name == "demolition" ? 5u : 0u);
    EXPECT_NEAR(play.mass, play.mass_put_in, 1e-6 * play.mass_put_in);
}

/// The others dent, flow and tear: what shows cracks there is what tears.
bool is_brittle(const std::string& scene) {
    for (const char* soft : {"rubber", "steel", "cloth", "tear", "panel", "drum", "car"})
        if (scene == soft) return false;
    return true;
}

TEST_P(EveryScene, IsDrawnClosedInEveryFrame) {
    const Alone& play = alone(GetParam());
    EXPECT_EQ(play.wrong_mesh, "");
    EXPECT_GE(play.meshes, play.born);
    EXPECT_EQ(play.wrong_drawn, "");
    EXPECT_GE(play.looked_at, play.born);
    if (is_brittle(GetParam().name)) {
        EXPECT_GT(play.with_cracks, 0u);
    }
}

// At the start it is large enough to be made out, and nearly all of what breaks stays in the picture, and in sight.
TEST_P(EveryScene, ItsCameraHoldsNearlyAllThatBreaksFromTheFirstPictureToTheEnd) {
    const Alone& play = alone(GetParam());
    ASSERT_FALSE(play.seen.empty());
    for (const auto& [frame, seen] : play.seen) EXPECT_GE(seen.inside, 0.9 * seen.all) << "frame " << frame;
    const auto& [frame, seen] = play.seen.back();
    const double first_height = play.seen.front().second.height();
    std::printf(
        "%s, frame %u: %.4f of the area in the picture, %.4f of it behind what does not break; at first %.2f of the "
        "picture's height\n",
        GetParam().name.c_str(), frame, seen.inside / seen.all, seen.hidden / seen.inside, first_height);
    EXPECT_GE(first_height, 0.15);
    EXPECT_GE(seen.inside, 0.95 * seen.all);
    EXPECT_LE(seen.hidden, 0.1 * seen.inside);
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
