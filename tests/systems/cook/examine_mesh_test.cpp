// What examine_mesh finds in meshes with known defects.
#include <gtest/gtest.h>

#include <limits>

#include "cullet/model.hpp"
#include "sample_game/props.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet {
namespace {

MeshReport examined(const Mesh& mesh) {
    const Result<MeshReport> report = examine_mesh(view_of(mesh));
    EXPECT_TRUE(report.ok()) << report.error();
    return report.ok() ? report.value() : MeshReport{};
}

TEST(ExamineMesh, ASoundSphereNeedsNothing) {
    const MeshReport report = examined(test::sphere_mesh(1, 2));
    EXPECT_EQ(report.parts, 1u);
    EXPECT_EQ(report.closed_parts, 1u);
    EXPECT_EQ(report.flipped_triangles + report.dropped_triangles + report.welded_vertices + report.split_edges, 0u);
    EXPECT_EQ(report.repairs, "Surface: nothing to repair.");
}

TEST(ExamineMesh, TrianglesThatWereTurnedAreCountedOnceWhateverTurnedThem) {
    Mesh some = test::sphere_mesh(1, 2), all = some;
    for (size_t t = 0; t < some.triangles.size(); t += 5) std::swap(some.triangles[t][0], some.triangles[t][1]);
    for (auto& t : all.triangles) std::swap(t[0], t[1]);
    EXPECT_EQ(examined(some).flipped_triangles, some.triangles.size() / 5);
    EXPECT_EQ(examined(all).flipped_triangles, all.triangles.size());
    // Most of them turned: the part is turned to agree first, and then whole. Counted are those that end otherwise.
    Mesh most = all;
    for (size_t t = 0; t < most.triangles.size(); t += 5) std::swap(most.triangles[t][0], most.triangles[t][1]);
    EXPECT_EQ(examined(most).flipped_triangles, most.triangles.size() - most.triangles.size() / 5);
}

TEST(ExamineMesh, AHoleStaysOpenAndIsNamed) {
    Mesh mesh = test::sphere_mesh(1, 2);
    mesh.triangles.pop_back();
    const MeshReport report = examined(mesh);
    EXPECT_EQ(report.open_borders, 1u);
    EXPECT_EQ(report.open_edges, 3u);
    EXPECT_EQ(report.closed_parts, 0u);
    EXPECT_NE(report.repairs.find("left 1 border open (3 edges)"), std::string::npos) << report.repairs;
}

TEST(ExamineMesh, AnEdgeOfThreeTrianglesIsSplit) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, -1}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
    const MeshReport report = examined(mesh);
    EXPECT_EQ(report.split_edges, 1u);
    EXPECT_GT(report.split_vertices, 0u);
}

TEST(ExamineMesh, WhatIsNoSurfaceIsRefused) {
    EXPECT_FALSE(examine_mesh({}).ok());
    Mesh mesh = test::sphere_mesh(1, 1);
    mesh.positions[3].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(examine_mesh(view_of(mesh)).ok());
}

}  // namespace
}  // namespace cullet
