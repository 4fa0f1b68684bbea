// The street of demolition from the first explosion on, in the long run to its last frame: the same in every build on
// any number of threads.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "sample_game/run_scene.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_program.hpp"

namespace cullet {
namespace {

constexpr uint32_t kAllFrames = 1200;
const uint32_t kFrames = test::few_or_all(200u, kAllFrames);

/// The Release game's report on so many threads.
nlohmann::json report_of_release(unsigned threads) {
    const std::string out = build_folder() + "/street/" + std::to_string(threads);
    const test::ProgramRun run =
        test::run_program({release_game(), "run", "demolition", "--frames", std::to_string(kFrames), "--threads",
                           std::to_string(threads), "--out", out});
    EXPECT_EQ(run.exit_code, 0) << run.error;
    std::ifstream file(out + "/report.json");
    return nlohmann::json::parse(file, nullptr, false);
}

/// A Checked build on one thread, and the Release game on 2 and 8, give the same bytes.
TEST(Demolition, TheStreetIsTheSameOnAnyNumberOfThreads) {
    RunOptions options;
    options.scene = "demolition";
    options.threads = 1;
    options.frames = kFrames;
    const Result<Report> played = play(plan_scene(*find_scene(options.scene), options), options);
    ASSERT_TRUE(played.ok()) << played.error();
    const Report& report = played.value();
    EXPECT_EQ(report.frames, kFrames);
    EXPECT_LE(report.fragments.live, 2000u);
    EXPECT_GT(report.fragments.born, test::few_or_all(500u, 2000u));
    // Of a thousand touches that are foreseen a third come so, in a shower of pieces that push each other. Nearly all
    // buildings break by explosions: none to five a street by touch alone, too few to ask a share of them to be ready.
    // ready_test asks that of scenes in which nothing else breaks a body.
    const uint64_t hits = report.tasks.ahead_hits, followed = hits + report.tasks.ahead_misses;
    EXPECT_GE(hits, test::few_or_all(50u, 200u));
    EXPECT_GE(4 * hits, followed);
    if (release_game().empty()) GTEST_SKIP() << "configure with -DCULLET_RELEASE_GAME=PROGRAM";
    for (const unsigned threads : test::few_or_all<std::vector<unsigned>>({8}, {2, 8})) {
        const nlohmann::json other = report_of_release(threads);
        ASSERT_TRUE(other.is_object()) << threads;
        EXPECT_EQ(other["hash_chain"], report.hash_chain) << threads << " threads";
        EXPECT_EQ(other["allocations_in_frames"], 0) << threads << " threads";
        EXPECT_EQ(other["allocations_in_rigid"], 0) << threads << " threads";
    }
}

}  // namespace
}  // namespace cullet
