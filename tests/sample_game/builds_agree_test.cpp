// A Checked build and a Release build give the same bytes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "sample_game/run_scene.hpp"
#include "tests/support/places.hpp"

namespace cullet {
namespace {

// scripts/test.sh builds the Release game first and names it when it configures this tree.
const std::string kReleaseGame = release_game();

class BuildsAgree : public testing::TestWithParam<Scene> {};

TEST_P(BuildsAgree, HashesOfAllFramesAreThoseOfTheReleaseGame) {
    if (kReleaseGame.empty()) GTEST_SKIP() << "configure with -DCULLET_RELEASE_GAME=PROGRAM";
    RunOptions options;
    options.scene = GetParam().name;
    options.frames = options.scene == "pile" ? 40 : 100;  // a dozen vases
    options.threads = 2;
    const std::string out = build_folder() + "/builds_agree/" + options.scene;
    const std::string command = kReleaseGame + " run " + options.scene + " --frames " + std::to_string(options.frames) +
                                " --threads 1 --out " + out + " >/dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    std::ifstream file(out + "/report.json");
    const auto other = nlohmann::json::parse(file);

    const Result<Report> own = play(plan_scene(GetParam(), options), options);
    ASSERT_TRUE(own.ok()) << own.error();
    EXPECT_EQ(own.value().hash, other["hash"]);
    EXPECT_EQ(own.value().hash_chain, other["hash_chain"]);
}

INSTANTIATE_TEST_SUITE_P(Scenes, BuildsAgree, testing::ValuesIn(scenes().begin(), scenes().end()),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace cullet
