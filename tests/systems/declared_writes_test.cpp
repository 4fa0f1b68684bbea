// What the frame plan prints is what its systems do: after each, only tables that it says that it writes are others.
#include <gtest/gtest.h>

#include <string>

#include "sample_game/run_scene.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/scene_hashes.hpp"
#include "tests/support/write_watch.hpp"

namespace cullet {
namespace {

class DeclaredWrites : public testing::TestWithParam<Scene> {};

/// Settings with which the scene breaks something early and stays small.
std::vector<std::string> short_form(const std::string& scene) {
    if (scene == "vase") return {"scene.height_m=0.3"};
    return {};
}

TEST_P(DeclaredWrites, EverySystemOfTheSceneKeepsToThem) {
    RunOptions options;
    options.scene = GetParam().name;
    options.threads = 1;
    options.set = short_form(options.scene);
    Result<GameWorld> game = GameWorld::create(plan_scene(GetParam(), options));
    ASSERT_TRUE(game.ok()) << game.error();
    test::WriteWatch watch(game->world());
    // Frames with hits are the ones that write; of the quiet ones each eighth tells enough.
    constexpr uint32_t kFrames = 240;
    const uint32_t most = test::few_or_all(6u, 40u);
    uint32_t watched = 0;
    for (uint32_t frame = 0; frame < kFrames && watched < most; ++frame) {
        game->before_step();
        const Tasks& tasks = game->world().contents().data.state.tasks;
        bool has_task = false;
        for (uint32_t t = 0; t < tasks.size(); ++t)
            has_task = has_task || tasks.state[t] != static_cast<uint8_t>(TaskState::Free);
        if (has_task || game->broke() || frame % 8 == 0) {
            watch.watch_next_step();
            ++watched;
        }
        game->step();
        game->after_step();
    }
    ASSERT_EQ(game->failure(), "");
    for (const std::string& sentence : watch.unsaid()) ADD_FAILURE() << sentence;
}

INSTANTIATE_TEST_SUITE_P(Scenes, DeclaredWrites, testing::ValuesIn(scenes().begin(), scenes().end()),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace cullet
