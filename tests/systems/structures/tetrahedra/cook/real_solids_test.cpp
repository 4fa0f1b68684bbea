// Solids from meshes of strangers: solid cooking note, sections 3 and 10.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "tests/support/data_files.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/real_meshes.hpp"
#include "tests/support/solid_checks.hpp"

namespace cullet {
namespace {

namespace fs = std::filesystem;

// What the note says of them. All others are solids.
const std::map<std::string, std::string> kRefused{
    {"apartment_block.glb", "is no solid"}, {"building_small_a.glb", "is no solid"},
    {"curtain.ply", "is no solid"},         {"curtain.glb", "is no solid"},
    {"curtains_double.glb", "is no solid"}, {"plastic_monobloc_chair_01_1k.gltf", "Use thick_shell"},
};

TEST(RealSolids, OfAllFoldersAreSoundOrRefused) {
    CULLET_SKIP_WITHOUT_DATA();
    uint32_t sound = 0, refused = 0;
    for (const char* folder : {"lattice", "convex", "thick_shell"})
        for (const fs::path& file : test::files_below(test::test_data() / folder)) {
            const std::string kind = file.extension();
            if (test::is_companion(file) || kind == ".vtk" || kind == ".bin" || kind == ".json") continue;
            const Mesh mesh = test::read_real_mesh(fs::relative(file, test::test_data()));
            if (mesh.triangles.empty()) continue;
            const Result<CookedSolid> made = cook_solid(mesh);
            const auto wanted = kRefused.find(file.filename());
            if (!made) {
                ++refused;
                EXPECT_TRUE(wanted != kRefused.end() && made.error().find(wanted->second) != std::string::npos)
                    << file << ": " << made.error();
                continue;
            }
            EXPECT_TRUE(wanted == kRefused.end()) << file << " became a solid";
            const test::SolidReport report = test::check_solid(*made);
            EXPECT_TRUE(report.is_sound()) << file << ": " << report;
            ++sound;
        }
    EXPECT_GE(sound, 22u);
    EXPECT_GE(refused, 4u);
}

TEST(RealSolids, HostileMeshesAreSoundOrRefused) {
    CULLET_SKIP_WITHOUT_DATA();
    uint32_t sound = 0;
    const fs::path cache = fs::path(testing::TempDir()) / ("cullet_real_solids." + std::to_string(getpid()));
    fs::create_directories(cache);
    const uint32_t every = test::few_or_all(3u, 1u);
    uint32_t seen = 0;
    for (const fs::path& file : test::files_below(test::test_data() / "hostile")) {
        if (test::is_companion(file) || seen++ % every != 0) continue;
        const Result<Mesh> mesh = import_mesh(file, build_folder() + "/cullet_import", cache);
        if (!mesh) continue;
        const Result<CookedSolid> made = cook_solid(*mesh);
        if (!made) {
            EXPECT_EQ(made.error().find("stays in a plane"), std::string::npos) << file << ": " << made.error();
            continue;
        }
        const test::SolidReport report = test::check_solid(*made);
        EXPECT_TRUE(report.is_sound()) << file << ": " << report;
        ++sound;
    }
    fs::remove_all(cache);
    EXPECT_GE(sound, 10 / every);
}

}  // namespace
}  // namespace cullet
