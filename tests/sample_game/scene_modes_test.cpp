// Pane and wall in every way to break: the same bytes on any number of threads, and the blow breaks something.
#include <gtest/gtest.h>

#include "sample_game/run_scene.hpp"
#include "systems/world_contents.hpp"
#include "tests/support/scene_hashes.hpp"

namespace cullet {
namespace {

constexpr uint32_t kFrames = 30;  // the balls arrive in the sixth and the ninth

struct SceneMode {
    const char *scene, *fracture, *cracks;
    uint32_t layers = 1;
};

std::vector<SceneMode> modes() {
    std::vector<SceneMode> all;
    for (const char* cracks : {"fine", "coarse", "large"}) {
        for (const char* scene : {"pane", "wall"})
            for (const uint32_t layers : {1u, 2u}) all.push_back({scene, "quick", cracks, layers});
        all.push_back({"wall", "hidden", cracks});
    }
    return all;
}

std::string name_of(const SceneMode& mode) {
    return std::string(mode.scene) + "_" + mode.fracture + "_" + mode.cracks + "_" + std::to_string(mode.layers);
}

ScenePlan plan_of(const SceneMode& mode) {
    RunOptions options;
    options.scene = mode.scene;
    options.set = {std::string("scene.fracture=") + mode.fracture, std::string("scene.cracks=") + mode.cracks,
                   "scene.layers=" + std::to_string(mode.layers)};
    ScenePlan plan = plan_scene(*find_scene(mode.scene), options);
    static const std::shared_ptr<ModelShelf> shelf = plan.shelf;  // a kind of fracture is cooked once
    plan.shelf = shelf;
    return plan;
}

class EveryMode : public testing::TestWithParam<SceneMode> {};

TEST_P(EveryMode, BreaksAndHashesAreEqualOnOneTwoThreeAndEightThreads) {
    ScenePlan plan = plan_of(GetParam());
    plan.threads = 1;
    Result<GameWorld> game = GameWorld::create(plan);
    ASSERT_TRUE(game.ok()) << game.error();
    std::vector<uint64_t> one;
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
        test::play_frame(*game);
        one.push_back(game->world().hash());
    }
    EXPECT_GT(game->world().contents().data.counts.cuts, 0u);
    EXPECT_EQ(game->sums().events["fault"], 0u);
    EXPECT_EQ(game->sums().events["refused"], 0u);
    for (const uint32_t threads : {2u, 3u, 8u}) {
        plan.threads = threads;
        EXPECT_EQ(test::difference(one, test::hashes_of(plan, kFrames)), "") << threads << " threads";
    }
}

INSTANTIATE_TEST_SUITE_P(Modes, EveryMode, testing::ValuesIn(modes()),
                         [](const auto& mode) { return name_of(mode.param); });

}  // namespace
}  // namespace cullet
