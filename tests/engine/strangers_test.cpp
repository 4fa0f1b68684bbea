// Every file of the data folder through the real import program.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "engine/import/sanitized.hpp"
#include "engine/mesh_file.hpp"
#include "tests/support/data_files.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/test_data.hpp"

namespace cullet {
namespace {

namespace fs = std::filesystem;

const std::string kProgram = build_folder() + "/cullet_import";
constexpr double kLongest = kIsSanitized ? 60 : 15;  // s
constexpr uint64_t kMostBytes = 3ull << 29;          // 1.5 GiB
constexpr const char* kRepairs[] = {"dropped ", "flipped ", "turned ", "split ", "left ", "found ", "took ", "kept "};

class Strangers : public testing::Test {
 protected:
    void SetUp() override {
        CULLET_SKIP_WITHOUT_DATA();
        folder_ = fs::temp_directory_path() / ("strangers_test." + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override {
        std::error_code error;
        if (!folder_.empty()) fs::remove_all(folder_, error);
    }
    test::ProgramRun import(const fs::path& file, const std::vector<std::string>& options = {}) {
        std::vector<std::string> arguments{kProgram, file, folder_ / "mesh.cmesh"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return test::run_program(arguments);
    }
    bool left_nothing() const { return fs::is_empty(folder_); }

    fs::path folder_;
};

/// One line that begins with the file and ends with a full stop.
void expect_a_sentence(const std::string& text, const std::string& file) {
    EXPECT_EQ(text.rfind(file + ": ", 0), 0u) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
    EXPECT_TRUE(text.size() > 2 && text.substr(text.size() - 2) == ".\n") << text;
}

bool names_a_repair(const std::string& line) {
    return std::any_of(std::begin(kRepairs), std::end(kRepairs),
                       [&](const char* repair) { return line.find(repair) != std::string::npos; });
}

bool is_sound(const std::string& line) {
    return line.find(", closed. ") != std::string::npos &&
           line.find("Surface: nothing to repair.") != std::string::npos;
}

void expect_within_limits(const test::ProgramRun& run, const std::string& file) {
    EXPECT_LT(run.seconds, kLongest) << file;
    EXPECT_LT(run.peak_bytes, kIsSanitized ? 16 * kMostBytes : kMostBytes) << file;
}

TEST_F(Strangers, EveryMeshThatIsNotHostileLoads) {
    size_t meshes = 0;
    for (const fs::path& file : test::files_below(test::test_data())) {
        if (file.parent_path().filename() == "hostile" || test::is_companion(file)) continue;
        const test::ProgramRun run = import(file);
        EXPECT_EQ(run.exit_code, 0) << run.error;
        expect_a_sentence(run.output, file);
        expect_within_limits(run, file);
        EXPECT_TRUE(read_mesh_file(folder_ / "mesh.cmesh").ok()) << file;
        fs::remove(folder_ / "mesh.cmesh");
        EXPECT_TRUE(left_nothing()) << file;
        ++meshes;
    }
    EXPECT_GE(meshes, 39u) << "in " << test::test_data();
}

// Buffers, point sets, ropes and tetrahedra stand in the same folders; given in place of a mesh they are refused.
TEST_F(Strangers, CompanionsThatAreNoMeshesAreRefusedInOneSentence) {
    for (const fs::path& file : test::files_below(test::test_data())) {
        if (!test::is_companion(file)) continue;
        const test::ProgramRun run = import(file);
        EXPECT_EQ(run.exit_code, 2) << file;
        expect_a_sentence(run.error, file);
        expect_within_limits(run, file);
        EXPECT_TRUE(left_nothing()) << file;
    }
}

TEST_F(Strangers, EveryHostileFileGetsWhatTheReadmeWants) {
    const auto wanted = test::wanted_of_hostile(test::test_data() / "README.md");
    EXPECT_GE(wanted.size(), 100u);
    size_t loaded = 0, refused = 0;
    for (const auto& [name, verdict] : wanted) {
        const fs::path file = test::test_data() / "hostile" / name;
        ASSERT_TRUE(fs::exists(file)) << file;
        const test::ProgramRun run = import(file);
        expect_within_limits(run, file);
        if (run.exit_code == 0) {
            ++loaded;
            expect_a_sentence(run.output, file);
            EXPECT_NE(verdict, 'R') << run.output;
            // Polygons may be cut so that the defect does not come about.
            EXPECT_TRUE(verdict != 'D' || names_a_repair(run.output) || is_sound(run.output)) << run.output;
            const auto mesh = read_mesh_file(folder_ / "mesh.cmesh");
            EXPECT_TRUE(mesh.ok()) << mesh.error();
            fs::remove(folder_ / "mesh.cmesh");
        } else {
            ++refused;
            EXPECT_EQ(run.exit_code, 2) << file;
            EXPECT_NE(verdict, 'L') << run.error;
            expect_a_sentence(run.error, file);
            EXPECT_EQ(run.output, "") << file;
        }
        EXPECT_TRUE(left_nothing()) << file;
    }
    std::printf("%zu of %zu hostile files loaded, %zu were refused\n", loaded, wanted.size(), refused);
}

TEST_F(Strangers, RepairsAreCounted) {
    const struct {
        const char* file;
        const char* says;
    } all[] = {{"half_flipped.obj", "flipped 112 triangles"},
               {"inside_out.obj",
                "flipped 224 triangles so that neighbours agree and outsides are outside, turned 1 "
                "inside-out part"},
               {"doubled_faces.obj", "dropped 264 repeated triangles"},
               {"two_cubes_share_edge.obj", "split 1 edge of more than two triangles"},
               {"bowtie_vertex.obj", "split off 1 vertex where several fans met"},
               {"moebius_strip.obj", "found 1 one-sided part"},
               {"two_cubes_overlap.obj", "found 12 pairs of triangles that cut or touch each other"},
               {"zero_area_faces.obj", "dropped 3 triangles with a repeated corner"},
               {"starts_with_solid.stl", "joined 558 equal points"},
               {"one_triangle.obj", "left 1 border open (3 edges)"}};
    for (const auto& [name, says] : all) {
        const test::ProgramRun run = import(test::test_data() / "hostile" / name);
        EXPECT_NE(run.output.find(says), std::string::npos) << run.output;
    }
}

TEST_F(Strangers, DracoCompressedFilesSurviveTheMemoryLimit) {
    for (const char* name : {"thick_shell/dogue.gltf", "thick_shell/espresso_cup.gltf", "metal_shell/old_van.gltf",
                             "metal_shell/rover_1.glb", "hostile/market_pillow.gltf"}) {
        const test::ProgramRun run = import(test::test_data() / name, {"--memory-mib", "1024"});
        EXPECT_EQ(run.exit_code, 0) << run.error;
        std::printf("%s: %.0f MiB at most\n", name, static_cast<double>(run.peak_bytes) / (1 << 20));
    }
}

}  // namespace
}  // namespace cullet
