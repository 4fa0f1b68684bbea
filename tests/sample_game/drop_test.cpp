// The scene `drop` with strangers' meshes: it breaks them, keeps their mass, and no hit is late.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "sample_game/drawn_meshes.hpp"
#include "sample_game/game_world.hpp"
#include "sample_game/run_scene.hpp"
#include "systems/world_contents.hpp"
#include "tests/support/places.hpp"

namespace cullet {
namespace {

std::filesystem::path data_folder() {
    if (const char* given = std::getenv("CULLET_TEST_DATA")) return std::filesystem::path(given) / "thick_shell";
    return std::filesystem::path(source_folder()) / "../shared/data/thick_shell";
}

class DropMesh : public testing::TestWithParam<const char*> {};

TEST_P(DropMesh, BreaksKeepsItsMassAndIsNeverLate) {
    const std::filesystem::path path = data_folder() / GetParam();
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no model at " << path << "; set CULLET_TEST_DATA";
    const Scene& drop = *find_scene("drop");
    RunOptions options;
    options.scene = drop.name;
    options.mesh = path;
    options.threads = 2;
    Result<GameWorld> game = GameWorld::create(plan_scene(drop, options));
    ASSERT_TRUE(game.ok()) << game.error();
    const ModelReport& model = game->stage().models[0].model.report();
    const std::vector<std::string>& notes = game->stage().notes;
    DrawnMeshes drawn;
    for (uint32_t frame = 0; frame < 120; ++frame) {
        game->before_step();
        game->step();
        game->after_step();
        ASSERT_EQ(drawn.check_changed(game->world()), "") << "frame " << frame;
        const Tasks& tasks = game->world().contents().data.state.tasks;
        for (uint32_t t = 0; t < tasks.size(); ++t)
            EXPECT_FALSE(static_cast<TaskState>(tasks.state[t]) != TaskState::Free && tasks.is_late[t] &&
                         tasks.frames_held[t] > 0)
                << "frame " << frame << ": the hold of task " << t << " ended before its hit";
    }
    EXPECT_GT(game->sums().born, 0u);
    EXPECT_NEAR(measure_matter(game->world()).mass, game->mass_put_in(), 1e-6 * game->mass_put_in());
    EXPECT_EQ(game->sums().events["fault"], 0u);
    const DamageCounts& counts = game->world().contents().data.counts;
    EXPECT_GT(counts.broke, 0u);
    // Bumps below the speed of the first crack are never held, so what they break of a cracked piece comes late.
    std::printf("%llu late, all of them bumps that are never held\n", static_cast<unsigned long long>(counts.late));
    EXPECT_LE(game->sums().units_used, counts.opened * model.units_of_a_hit);
    std::printf("%s: %llu born, %.1f million units used in %llu tasks of %.1f predicted\n", GetParam(),
                static_cast<unsigned long long>(game->sums().born), 1e-6 * static_cast<double>(game->sums().units_used),
                static_cast<unsigned long long>(counts.opened), 1e-6 * static_cast<double>(model.units_of_a_hit));
    // One note on the budget, not two that contradict each other.
    const auto budget_notes = std::count_if(notes.begin(), notes.end(), [](const std::string& note) {
        return note.find("units_a_frame") != std::string::npos;
    });
    EXPECT_LE(budget_notes, 1);
}

INSTANTIATE_TEST_SUITE_P(Strangers, DropMesh, testing::Values("spot_triangulated.obj", "husky_loop1.ply"),
                         [](const auto& file) {
                             const std::string name = file.param;
                             return name.substr(0, name.find_first_of("_"));
                         });

}  // namespace
}  // namespace cullet
