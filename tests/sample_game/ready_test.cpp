// Whole bodies that break by touch: how many are ready when they touch, since it was foreseen.
#include <gtest/gtest.h>

#include <string>

#include "sample_game/run_scene.hpp"
#include "tests/support/effort.hpp"

namespace cullet {
namespace {

class Foreseen : public testing::TestWithParam<const char*> {};

TEST_P(Foreseen, FourOfFiveFirstBreaksByTouchAreReady) {
    const uint32_t plays = test::few_or_all(2u, 3u);
    uint64_t breaks = 0, ready = 0;
    for (uint32_t seed = 1; seed <= plays; ++seed) {
        RunOptions options;
        options.scene = GetParam();
        options.set = {"scene.seed=" + std::to_string(seed)};
        options.threads = 1;
        const Result<Report> played = play(plan_scene(*find_scene(options.scene), options), options);
        ASSERT_TRUE(played.ok()) << played.error();
        breaks += played.value().tasks.first_breaks;
        ready += played.value().tasks.first_ready;
    }
    EXPECT_GE(breaks, plays);
    EXPECT_GE(static_cast<double>(ready), 0.8 * static_cast<double>(breaks));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Foreseen, testing::Values("vase", "wall", "pane"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace cullet
