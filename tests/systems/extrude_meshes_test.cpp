// Extrusion of the models of the data folder: the invariants, and a table of what was reached in which time.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "systems/cook/crossings.hpp"
#include "systems/cook/extrude.hpp"
#include "tests/support/plain_reader.hpp"
#include "tests/support/shell_checks.hpp"

namespace cullet {
namespace {

std::string data_folder() {
    const char* given = std::getenv("CULLET_TEST_DATA");
    return (given ? std::string(given) : std::string(CULLET_SOURCE_DIR) + "/../shared/data") + "/thick_shell";
}

double milliseconds() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

TEST(ExtrudeMeshes, TheTableOfTimesAndWalls) {
    if (!std::filesystem::exists(data_folder())) GTEST_SKIP() << "no models at " << data_folder() << "; set CULLET_TEST_DATA";
    std::printf("%-24s %9s %5s %8s %8s %6s %6s %6s %6s %7s %7s\n", "mesh", "triangles", "eps%", "cross ms", "ms", "wall", "5th", "least", "flat", "pairs", "coll");
    for (const char* name : {"spot_triangulated.obj", "husky_loop1.ply", "bowl.ply", "vase_thick.ply", "curtain.ply"}) {
        const std::string path = data_folder() + "/" + name;
        if (!std::filesystem::exists(path)) continue;
        const Result<Surface> surface = prepare_surface(test::read_plain(path));
        ASSERT_TRUE(surface) << surface.error();
        double crossing = 1e9;
        for (int repeat = 0; repeat < 3; ++repeat) {
            const double start = milliseconds();
            (void)find_crossings(surface.value());
            crossing = std::min(crossing, milliseconds() - start);
        }
        for (const double percent : {1.0, 3.0, 10.0}) {
            const double eps = percent / 100 * surface->diagonal;
            double least = 1e9;
            Result<Extrusion> shell = Error{"not run"};
            for (int repeat = 0; repeat < 3; ++repeat) {
                const double start = milliseconds();
                shell = extrude(surface.value(), eps);
                least = std::min(least, milliseconds() - start);
            }
            ASSERT_TRUE(shell) << shell.error();
            const TrueWall wall = measure_true_wall(surface.value(), shell.value(), eps);
            std::printf("%-24s %9zu %5.0f %8.1f %8.1f %6.3f %6.3f %6.3f %6u %7u %7u\n", name, surface->triangles.size(), percent,
                        crossing, crossing + least, wall.mean, wall.low, wall.least, shell->statistics.degenerate_elements, shell->statistics.pairs, shell->statistics.collisions);
        }
    }
}

TEST(ExtrudeMeshes, EveryModelAtOneFiveAndTwentyPercentIsSound) {
    if (!std::filesystem::exists(data_folder())) GTEST_SKIP() << "no models at " << data_folder() << "; set CULLET_TEST_DATA";
    for (const char* name : {"spot_triangulated.obj", "husky_loop1.ply", "bowl.ply", "vase_thick.ply", "curtain.ply"}) {
        const std::string path = data_folder() + "/" + name;
        if (!std::filesystem::exists(path)) continue;
        const Result<Surface> surface = prepare_surface(test::read_plain(path));
        ASSERT_TRUE(surface) << surface.error();
        std::printf("%s: %s\n", name, describe(surface->repairs).c_str());
        for (const double percent : {1.0, 5.0, 20.0}) {
            const double eps = percent / 100 * surface->diagonal;
            const Result<Extrusion> shell = extrude(surface.value(), eps);
            ASSERT_TRUE(shell) << shell.error();
            const test::ShellReport report = test::check_shell(surface.value(), shell.value(), eps);
            EXPECT_TRUE(report.is_sound()) << name << " at " << percent << " %: " << report;
            EXPECT_EQ(shell->statistics.depth_zero_vertices, shell->statistics.frozen_vertices) << name << " at " << percent << " %";
        }
    }
}

}  // namespace
}  // namespace cullet
