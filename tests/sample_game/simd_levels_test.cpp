// A scene gives the same bytes at every level of SIMD that this machine has.
#include <gtest/gtest.h>

#include "engine/simd.hpp"
#include "sample_game/run_scene.hpp"

namespace cullet {
namespace {

class SimdLevels : public testing::Test {
 protected:
    void TearDown() override { set_simd_level(SimdLevel::Best); }
};

Result<Report> pane_at(const std::string& level, uint32_t frames = 40) {
    RunOptions options;
    options.scene = "pane";
    options.frames = frames;
    options.threads = 2;
    options.set = {"simd=" + level, "scene.edge_m=0.03"};
    return play(plan_scene(*find_scene("pane"), options), options);
}

TEST_F(SimdLevels, APaneBreaksWithTheSameBytesAtEachOfThem) {
    const Result<Report> best = pane_at("best");
    ASSERT_TRUE(best.ok()) << best.error();
    EXPECT_GT(best->fragments.born, 0u);
    for (const char* level : {"scalar", "sse4", "avx2", "avx512"}) {
        if (const Result<void> there = set_simd_level(std::string(level)); !there.ok()) {
            std::printf("not looked at: %s\n", there.error().c_str());
            continue;
        }
        const Result<Report> other = pane_at(level);
        ASSERT_TRUE(other.ok()) << other.error();
        EXPECT_EQ(other->hash_chain, best->hash_chain) << level;
    }
}

TEST_F(SimdLevels, PlainLoopsAreEverywhere) {
    EXPECT_TRUE(set_simd_level(SimdLevel::Scalar));
    EXPECT_TRUE(set_simd_level(SimdLevel::Best));
}

TEST_F(SimdLevels, ALevelThatIsNotThereIsRefusedInOneSentence) {
    const Result<void> none = set_simd_level(std::string("neon"));
    ASSERT_FALSE(none.ok());
    EXPECT_NE(none.error().find("give one of best, scalar"), std::string::npos) << none.error();
    const Result<Report> run = pane_at("neon", 1);
    ASSERT_FALSE(run.ok());
    EXPECT_NE(run.error().find("simd is one of best, scalar"), std::string::npos) << run.error();
}

}  // namespace
}  // namespace cullet
