// The game and strangers' files: what is refused ends it with exit code 2 and one sentence; what loads cooks and runs.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <sstream>

#include "cullet/model.hpp"
#include "engine/import/sanitized.hpp"
#include "sample_game/cache.hpp"
#include "sample_game/import_model.hpp"
#include "sample_game/props.hpp"
#include "tests/support/data_files.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/test_data.hpp"

namespace cullet {
namespace {

namespace fs = std::filesystem;

const std::string kGame = build_folder() + "/sample_game";

size_t files_in(const fs::path& folder) {
    size_t count = 0;
    if (fs::exists(folder))
        for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder)) ++count;
    return count;
}

/// The last line: lines of progress may come before.
std::string last_line(std::string text) {
    if (!text.empty() && text.back() == '\n') text.pop_back();
    return text.substr(text.rfind('\n') + 1);
}

TEST(StrangersGame, AFileThatIsRefusedEndsTheRunWithOneSentenceAndExitCode2) {
    CULLET_SKIP_WITHOUT_DATA();
    const size_t kept = files_in(cache_folder());
    for (const auto& [name, verdict] : test::wanted_of_hostile(test::test_data() / "README.md")) {
        if (verdict != 'R') continue;
        const fs::path file = test::test_data() / "hostile" / name;
        const test::ProgramRun run = test::run_program({kGame, "run", "drop", "--mesh", file, "--frames", "1"});
        const std::string sentence = last_line(run.error);
        EXPECT_EQ(run.exit_code, 2) << sentence;
        EXPECT_EQ(sentence.rfind(fs::absolute(file).string() + ": ", 0), 0u) << sentence;
        EXPECT_EQ(sentence.back(), '.') << sentence;
        EXPECT_EQ(run.output, "");
        EXPECT_LT(run.seconds, kIsSanitized ? 60 : 15) << name;
    }
    EXPECT_EQ(files_in(cache_folder()), kept);
}

// In the game's own process: a file that loads is cooked, or refused in a sentence, and the process goes on.
TEST(StrangersGame, AHostileFileThatLoadsCooksOrIsRefusedInASentence) {
    CULLET_SKIP_WITHOUT_DATA();
    const uint32_t every = test::few_or_all(2u, 1u);
    uint32_t seen = 0;
    for (const auto& [name, verdict] : test::wanted_of_hostile(test::test_data() / "README.md")) {
        if (verdict == 'R' || seen++ % every != 0) continue;
        const Result<Mesh> mesh = import_model(test::test_data() / "hostile" / name);
        if (!mesh.ok()) continue;  // strangers_test says whether it may be
        Vec3 low = mesh->positions[0], high = low;
        for (const Vec3 p : mesh->positions) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        CookSettings settings;
        settings.thickness = 0.02f * std::max({high.x - low.x, high.y - low.y, high.z - low.z});
        settings.longest_edge = 10 * settings.thickness;
        settings.thick_shell.measures_threshold = false;
        const Result<Model> model = cook(view_of(*mesh), settings);
        std::printf(
            "%c %s: %s\n", verdict, name.c_str(),
            model.ok() ? (std::to_string(model->report().elements) + " elements").c_str() : model.error().c_str());
        if (model.ok()) {
            EXPECT_GT(model->report().mass, 0) << name;
        } else {
            EXPECT_EQ(model.error().rfind(mesh->name + ": ", 0), 0u) << model.error();
            EXPECT_EQ(model.error().back(), '.') << model.error();
            EXPECT_EQ(model.error().find('\n'), std::string::npos) << model.error();
        }
    }
}

TEST(StrangersGame, CookWritesAModelFileThatReads) {
    CULLET_SKIP_WITHOUT_DATA();
    const fs::path folder = fs::temp_directory_path() / ("strangers_game_test." + std::to_string(getpid()));
    fs::create_directories(folder);
    const std::string mesh = test::test_data() / "lattice/banana.obj", model = folder / "banana.cmodel";
    const std::vector<std::string> arguments{kGame,   "cook",          mesh,    "--out",    model, "--material",
                                             "glass", "--thickness-m", "0.004", "--edge-m", "0.02"};
    const test::ProgramRun first = test::run_program(arguments), second = test::run_program(arguments);
    EXPECT_EQ(first.exit_code, 0) << first.error;
    EXPECT_NE(second.output.find("The cooked model was taken from the cache."), std::string::npos) << second.output;
    const Result<Model> read = read_model(model);
    ASSERT_TRUE(read.ok()) << read.error();
    EXPECT_GT(read->report().mass, 0);
    EXPECT_NEAR(read->report().mean_thickness, 0.004, 0.0004);  // measured along the ways in, which lean
    for (const auto& wrong : {std::vector<std::string>{kGame, "cook", mesh, "--out", folder / "none" / "x.cmodel"},
                              {kGame, "cook", mesh, "--out", model, "--material", "cheese"},
                              {kGame, "cook", folder / "none.obj", "--out", model},
                              {kGame, "cook", mesh, "--out", model, "--thickness-m", "50"}}) {
        const test::ProgramRun run = test::run_program(wrong);
        EXPECT_EQ(run.exit_code, 2) << run.output;
        // One sentence, after lines of progress where cooking takes more than five seconds.
        std::istringstream lines(run.error);
        std::vector<std::string> sentences;
        for (std::string line; std::getline(lines, line);)
            if (!line.starts_with("cooking ")) sentences.push_back(line);
        ASSERT_EQ(sentences.size(), 1u) << run.error;
        EXPECT_EQ(sentences[0].back(), '.') << run.error;
    }
    fs::remove_all(folder);
}

TEST(StrangersGame, TheSecondRunWithAMeshDoesNotCookAgainAndIsTheSame) {
    CULLET_SKIP_WITHOUT_DATA();
    const std::vector<std::string> arguments{
        kGame,      "run", "drop",  "--mesh",           test::test_data() / "lattice/ball.obj",
        "--frames", "25",  "--set", "scene.edge_m=0.04"};
    const test::ProgramRun first = test::run_program(arguments), second = test::run_program(arguments);
    ASSERT_EQ(first.exit_code, 0) << first.error;
    const auto line = [](const std::string& text, const char* begin) {
        const size_t at = text.find(begin);
        return at == text.npos ? "" : text.substr(at, text.find('\n', at) - at);
    };
    EXPECT_NE(second.output.find("The cooked model was taken from the cache."), std::string::npos) << second.output;
    EXPECT_NE(line(first.output, "hash "), "") << first.output;
    EXPECT_EQ(line(first.output, "hash "), line(second.output, "hash "));
}

}  // namespace
}  // namespace cullet
