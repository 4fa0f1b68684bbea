// The street of demolition from the first explosion on, in the long run to its last frame: the same on any
// number of threads.
#include <gtest/gtest.h>

#include "sample_game/run_scene.hpp"
#include "tests/support/effort.hpp"

namespace cullet {
namespace {

constexpr uint32_t kAllFrames = 1200;
const uint32_t kFrames = test::few_or_all(120u, kAllFrames);

Report play_on(uint32_t threads) {
    RunOptions options;
    options.scene = "demolition";
    options.threads = threads;
    options.frames = kFrames;
    const Result<Report> played = play(plan_scene(*find_scene(options.scene), options), options);
    EXPECT_TRUE(played.ok()) << played.error();
    return played.ok() ? played.value() : Report{};
}

TEST(Demolition, TheStreetIsTheSameOnAnyNumberOfThreads) {
    const Report report = play_on(1);
    EXPECT_EQ(report.frames, kFrames);
    EXPECT_LE(report.fragments.live, 2000u);
    EXPECT_GT(report.fragments.born, test::few_or_all(500u, 2000u));
    // Of a thousand touches that are foreseen a third come so, in a shower of pieces that push each other. Nearly all
    // buildings break by explosions: none to five a street by touch alone, too few to ask a share of them to be ready.
    // ready_test asks that of scenes in which nothing else breaks a body.
    const uint64_t hits = report.tasks.ahead_hits, followed = hits + report.tasks.ahead_misses;
    EXPECT_GE(hits, test::few_or_all(30u, 150u));  // enough to look at; how many there are hangs on every bit
    EXPECT_GE(4 * hits, followed);
    for (const uint32_t threads : test::few_or_all<std::vector<uint32_t>>({8}, {2, 8})) {
        const Report other = play_on(threads);
        EXPECT_EQ(other.hash_chain, report.hash_chain) << threads << " threads";
        EXPECT_EQ(other.allocations_in_frames, 0u) << threads << " threads";
        EXPECT_EQ(other.allocations_in_rigid, 0u) << threads << " threads";
    }
}

}  // namespace
}  // namespace cullet
