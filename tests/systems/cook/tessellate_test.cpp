#include "systems/cook/tessellate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "systems/cook/surface.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet {
namespace {

double longest_edge(const Mesh& mesh) {
    double longest = 0;
    for (const auto& t : mesh.triangles)
        for (size_t k = 0; k < 3; ++k)
            longest = std::max(longest, length(Vec3d(mesh.positions[t[k]]) - Vec3d(mesh.positions[t[(k + 1) % 3]])));
    return longest;
}

double area(const Mesh& mesh) {
    double sum = 0;
    for (const auto& t : mesh.triangles) {
        const Vec3d a(mesh.positions[t[0]]);
        sum += length(cross(Vec3d(mesh.positions[t[1]]) - a, Vec3d(mesh.positions[t[2]]) - a)) / 2;
    }
    return sum;
}

// Corner positions of every triangle, sorted: the same for meshes that differ in numbering alone.
std::vector<std::array<double, 9>> shape(const Mesh& mesh) {
    std::vector<std::array<double, 9>> result;
    for (const auto& t : mesh.triangles) {
        std::array<std::array<double, 3>, 3> corners;
        for (size_t k = 0; k < 3; ++k)
            corners[k] = {mesh.positions[t[k]].x, mesh.positions[t[k]].y, mesh.positions[t[k]].z};
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        std::array<double, 9> flat;
        for (size_t k = 0; k < 9; ++k) flat[k] = corners[k / 3][k % 3];
        result.push_back(flat);
    }
    std::sort(result.begin(), result.end());
    return result;
}

TEST(Tessellate, NoEdgeStaysLongerThanTheLimitAndTheSurfaceStaysClosed) {
    for (const double limit : {0.9, 0.3, 0.11}) {
        const Mesh box = test::box_mesh({1, 0.7, 0.4}, 1);
        Result<Mesh> fine = tessellate(box, {limit});
        ASSERT_TRUE(fine) << fine.error();
        EXPECT_LE(longest_edge(*fine), limit);
        EXPECT_NEAR(area(*fine), area(box), 1e-6);
        const Result<Surface> surface = prepare_surface(*fine);
        ASSERT_TRUE(surface) << surface.error();
        EXPECT_TRUE(surface->border_edges.empty());
        EXPECT_TRUE(surface->repairs.is_clean()) << describe(surface->repairs);
        EXPECT_NEAR(surface->components[0].volume, 0.28, 1e-6);
    }
}

TEST(Tessellate, ASheetOfDoubledVerticesHasNoTJunctions) {
    // Two triangles of a square that share no vertex, as a mesh with a seam comes.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    const Result<Mesh> fine = tessellate(mesh, {0.2});
    ASSERT_TRUE(fine);
    const Result<Surface> surface = prepare_surface(fine.value());
    ASSERT_TRUE(surface);
    EXPECT_EQ(surface->components.size(), 1u);
    double border = 0;
    for (const BorderEdge& e : surface->border_edges) {
        const Triangle& t = surface->triangles[e.triangle];
        border += length(surface->positions[t[e.edge]] - surface->positions[t[(e.edge + 1) % 3]]);
    }
    EXPECT_NEAR(border, 4.0, 1e-6);
}

TEST(Tessellate, CornerAttributesFollowThePositionsLinearly) {
    Mesh mesh = test::sheet_mesh(2, 1, 1, 1);
    for (const auto& t : mesh.triangles) {
        for (const uint32_t v : t) {
            mesh.corner_uvs.push_back({3 * mesh.positions[v].x, 1 - mesh.positions[v].y});
            mesh.corner_normals.push_back({0, 0, 1});
        }
        mesh.materials.push_back(static_cast<uint16_t>(mesh.materials.size() + 7));
    }
    const Result<Mesh> fine = tessellate(mesh, {0.13});
    ASSERT_TRUE(fine);
    ASSERT_EQ(fine->corner_uvs.size(), 3 * fine->triangles.size());
    ASSERT_EQ(fine->materials.size(), fine->triangles.size());
    for (size_t c = 0; c < fine->corner_uvs.size(); ++c) {
        const Vec3 p = fine->positions[fine->triangles[c / 3][c % 3]];
        EXPECT_NEAR(fine->corner_uvs[c].x, 3 * p.x, 1e-5);
        EXPECT_NEAR(fine->corner_uvs[c].y, 1 - p.y, 1e-5);
        EXPECT_EQ(fine->corner_normals[c].z, 1.0f);
        // The diagonal separates the two source triangles, and with them their materials.
        const float side = p.x - 2 * p.y;
        EXPECT_TRUE(fine->materials[c / 3] == 7 ? side >= -1e-5f : side <= 1e-5f);
    }
}

TEST(Tessellate, TheShapeDoesNotDependOnTheNumbering) {
    const Mesh torus = test::torus_mesh(1, 0.3, 7, 5);
    const auto expected = shape(tessellate(torus, {0.2}).value());
    EXPECT_GT(expected.size(), 500u);
    for (const uint64_t seed : {1ull, 2ull})
        EXPECT_EQ(shape(tessellate(test::shuffled(torus, seed), {0.2}).value()), expected);
}

TEST(Tessellate, AMeshThatIsFineEnoughComesBackUnchanged) {
    const Mesh sphere = test::sphere_mesh(1, 2);
    const Result<Mesh> same = tessellate(sphere, {1.0});
    ASSERT_TRUE(same);
    EXPECT_EQ(same->triangles, sphere.triangles);
}

TEST(Tessellate, RefusesALimitThatIsNoLengthAndAMeshThatWouldGrowTooLarge) {
    const Mesh box = test::box_mesh({1, 1, 1}, 1);
    EXPECT_FALSE(tessellate(box, {0.0}));
    EXPECT_FALSE(tessellate(box, {-1.0}));
    EXPECT_FALSE(tessellate(box, {std::numeric_limits<double>::quiet_NaN()}));
    const Result<Mesh> large = tessellate(box, {1e-4, 10000});
    ASSERT_FALSE(large);
    EXPECT_NE(large.error().find("10000"), std::string::npos);
}

}  // namespace
}  // namespace cullet
