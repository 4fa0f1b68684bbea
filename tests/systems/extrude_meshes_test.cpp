// Extrusion of the models of the data folder: the invariants, and a table of what was reached in which time.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>

#include "systems/cook/crossings.hpp"
#include "systems/cook/extrude.hpp"
#include "tests/support/plain_reader.hpp"
#include "tests/support/shell_checks.hpp"
#include "tests/support/true_wall.hpp"

namespace cullet {
namespace {

std::string data_folder() {
    const char* given = std::getenv("CULLET_TEST_DATA");
    return (given ? std::string(given) : std::string(CULLET_SOURCE_DIR) + "/../shared/data") + "/thick_shell";
}

// Of this thread, so that what else runs on the machine counts less.
double milliseconds() {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

TEST(ExtrudeMeshes, TheTableOfTimesAndWalls) {
    if (!std::filesystem::exists(data_folder()))
        GTEST_SKIP() << "no models at " << data_folder() << "; set CULLET_TEST_DATA";
    std::printf("%-22s %9s %4s %9s %9s %7s %6s %6s %6s %6s %6s %6s %10s\n", "mesh", "triangles", "eps%", "embree ms",
                "cross ms", "all ms", "ratio", "wall", "5th %", "least", "flat", "pairs", "set back");
    for (const char* name : {"spot_triangulated.obj", "husky_loop1.ply", "bowl.ply", "vase_thick.ply", "curtain.ply"}) {
        const std::string path = data_folder() + "/" + name;
        if (!std::filesystem::exists(path)) continue;
        const Result<Surface> surface = prepare_surface(test::read_plain(path));
        ASSERT_TRUE(surface) << surface.error();
        double crossing = 1e9, embree = 1e9;
        std::vector<Vec3> points;
        for (const Vec3d p : surface->positions) points.push_back(p.to_float());
        for (int repeat = 0; repeat < 3; ++repeat) {
            const double start = milliseconds();
            (void)find_crossings(surface.value());
            crossing = std::min(crossing, milliseconds() - start);
            const double build = milliseconds();
            const RayScene rays(points, surface->triangles);
            embree = std::min(embree, milliseconds() - build);
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
            std::printf("%-22s %9zu %4.0f %9.2f %9.1f %7.1f %6.1f %6.3f %6.3f %6.3f %6u %6u %10u\n", name,
                        surface->triangles.size(), percent, embree, crossing, crossing + least,
                        (crossing + least) / embree, wall.mean, wall.low, wall.least,
                        shell->statistics.degenerate_elements, shell->statistics.pairs, shell->statistics.collisions);
        }
    }
}

TEST(ExtrudeMeshes, EveryModelAtOneFiveAndTwentyPercentIsSound) {
    if (!std::filesystem::exists(data_folder()))
        GTEST_SKIP() << "no models at " << data_folder() << "; set CULLET_TEST_DATA";
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
            EXPECT_EQ(shell->statistics.depth_zero_vertices, shell->statistics.frozen_vertices)
                << name << " at " << percent << " %";
        }
    }
}

TEST(ExtrudeMeshes, HostileModelsAreBuiltOrRefusedAndSoundWhereTheyDoNotCross) {
    const std::string folder = data_folder() + "/../hostile/";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no models at " << folder << "; set CULLET_TEST_DATA";
    for (const char* name : {"bowtie_vertex.obj",
                             "doubled_faces.obj",
                             "far_from_origin.obj",
                             "fin_and_inner_wall.obj",
                             "half_flipped.obj",
                             "huge_scale.obj",
                             "inside_out.obj",
                             "klein_bottle.ply",
                             "manifold_openscad-nonmanifold-crash.obj",
                             "moebius_strip.obj",
                             "nan_vertices.obj",
                             "nine_sheets_one_edge.obj",
                             "one_triangle.obj",
                             "slivers_1e-7.obj",
                             "t_junctions.obj",
                             "three_sheets_one_edge.obj",
                             "tiny_scale.obj",
                             "two_cubes_overlap.obj",
                             "two_cubes_share_edge.obj",
                             "unused_vertices.obj",
                             "zero_area_faces.obj"}) {
        if (!std::filesystem::exists(folder + name)) continue;
        const Result<Surface> surface = prepare_surface(test::read_plain(folder + name));
        if (!surface) {
            EXPECT_GT(surface.error().size(), 20u);
            continue;
        }
        for (const double percent : {1.0, 20.0}) {
            const double eps = percent / 100 * surface->diagonal;
            const Result<Extrusion> shell = extrude(surface.value(), eps);
            ASSERT_TRUE(shell) << name << ": " << shell.error();
            const test::ShellReport report = test::check_shell(surface.value(), shell.value(), eps);
            EXPECT_TRUE(report.is_sound()) << name << " at " << percent << " %: " << report;
        }
    }
}

}  // namespace
}  // namespace cullet
