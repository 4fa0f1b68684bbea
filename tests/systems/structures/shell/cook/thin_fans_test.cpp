#include "systems/structures/shell/cook/thin_fans.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "cullet/model.hpp"
#include "sample_game/props.hpp"
#include "systems/cook/surface.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet {
namespace {

constexpr uint32_t kMost = 64;

/// A double cone of so many sides, or with height 0 and one side only a disc with an open border.
Mesh cone(uint32_t sides, double height, bool has_foot) {
    Mesh mesh;
    mesh.name = "cone";
    mesh.positions = {{0, static_cast<float>(height), 0}};
    for (uint32_t i = 0; i < sides; ++i) {
        const double angle = 2 * test::kPi * i / sides;
        mesh.positions.push_back(Vec3d(std::cos(angle), 0, std::sin(angle)).to_float());
    }
    if (has_foot) mesh.positions.push_back({0, static_cast<float>(-height), 0});
    for (uint32_t i = 0; i < sides; ++i) {
        const uint32_t a = 1 + i, b = 1 + (i + 1) % sides;
        mesh.triangles.push_back({0, b, a});
        if (has_foot) mesh.triangles.push_back({sides + 1, a, b});
    }
    for (size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
        mesh.corner_normals.push_back({0, 1, 0});
        const Vec3 p = mesh.positions[mesh.triangles[c / 3][c % 3]];
        mesh.corner_uvs.push_back({p.x, p.z});
    }
    mesh.materials.assign(mesh.triangles.size(), 7);
    return mesh;
}

uint32_t most_triangles_at_a_vertex(const Mesh& mesh) {
    std::vector<uint32_t> uses(mesh.positions.size());
    for (const auto& t : mesh.triangles)
        for (const uint32_t v : t) ++uses[v];
    return *std::max_element(uses.begin(), uses.end());
}

double area(const Mesh& mesh) {
    double sum = 0;
    for (const auto& t : mesh.triangles) {
        const Vec3d a(mesh.positions[t[0]]);
        sum += length(cross(Vec3d(mesh.positions[t[1]]) - a, Vec3d(mesh.positions[t[2]]) - a)) / 2;
    }
    return sum;
}

TEST(ThinFans, APoleOfManyTrianglesGetsFewAndTheMeshStaysClosed) {
    for (const uint32_t sides : {65u, 72u, 301u, 1000u}) {
        Mesh mesh = cone(sides, 0.4, true);
        EXPECT_EQ(thin_fans(mesh, kMost), 2u);
        EXPECT_LE(most_triangles_at_a_vertex(mesh), kMost) << sides;
        const Result<Surface> surface = prepare_surface(mesh);
        ASSERT_TRUE(surface) << surface.error();
        EXPECT_TRUE(surface->repairs.is_clean()) << sides << ": " << describe(surface->repairs);
        EXPECT_EQ(surface->repairs.open_borders, 0u);
        EXPECT_EQ(surface->components.size(), 1u);
    }
}

TEST(ThinFans, AFlatFanKeepsItsAreaItsPlaneAndItsTextureCoordinates) {
    Mesh mesh = cone(200, 0, false);
    const double before = area(mesh);
    EXPECT_EQ(thin_fans(mesh, kMost), 1u);
    EXPECT_LE(most_triangles_at_a_vertex(mesh), kMost);
    EXPECT_NEAR(area(mesh), before, 1e-6 * before);
    for (const Vec3 p : mesh.positions) EXPECT_EQ(p.y, 0);
    ASSERT_EQ(mesh.corner_uvs.size(), 3 * mesh.triangles.size());
    ASSERT_EQ(mesh.corner_normals.size(), 3 * mesh.triangles.size());
    ASSERT_EQ(mesh.materials.size(), mesh.triangles.size());
    for (size_t c = 0; c < mesh.corner_uvs.size(); ++c) {
        const Vec3 p = mesh.positions[mesh.triangles[c / 3][c % 3]];
        EXPECT_NEAR(mesh.corner_uvs[c].x, p.x, 1e-6f);
        EXPECT_NEAR(mesh.corner_uvs[c].y, p.z, 1e-6f);
        EXPECT_EQ(mesh.materials[c / 3], 7);
    }
    for (const auto& t : mesh.triangles)  // none turned over
        EXPECT_GT(cross(Vec3d(mesh.positions[t[1]]) - Vec3d(mesh.positions[t[0]]),
                        Vec3d(mesh.positions[t[2]]) - Vec3d(mesh.positions[t[0]]))
                      .y,
                  0);
}

TEST(ThinFans, AMeshWithoutCrowdedPolesStaysAsItIs) {
    Mesh mesh = cone(64, 0.4, true);
    const Mesh before = mesh;
    EXPECT_EQ(thin_fans(mesh, kMost), 0u);
    EXPECT_EQ(mesh.triangles, before.triangles);
    EXPECT_EQ(mesh.positions.size(), before.positions.size());
}

TEST(ThinFans, AFanOfFoldsStaysAsItIs) {
    Mesh mesh = cone(80, 0, false);
    for (size_t v = 1; v < mesh.positions.size(); v += 2) mesh.positions[v].y = 0.5f;
    const size_t triangles = mesh.triangles.size();
    EXPECT_EQ(thin_fans(mesh, kMost), 1u);
    EXPECT_EQ(mesh.triangles.size(), triangles);
}

TEST(ThinFans, TheResultDoesNotDependOnTheNumbering) {
    const Mesh mesh = cone(150, 0.3, true);
    Mesh other = mesh;
    const auto count = static_cast<uint32_t>(mesh.positions.size());
    for (uint32_t v = 0; v < count; ++v) other.positions[count - 1 - v] = mesh.positions[v];
    for (auto& t : other.triangles) t = {count - 1 - t[1], count - 1 - t[2], count - 1 - t[0]};
    std::reverse(other.triangles.begin(), other.triangles.end());
    const auto shape = [](Mesh m) {
        m.corner_normals.clear(), m.corner_uvs.clear(), m.materials.clear();
        thin_fans(m, kMost);
        return prepare_surface(m).value().triangles;
    };
    EXPECT_EQ(shape(mesh), shape(other));
}

TEST(ThinFans, CookingThinsAPoleAndSaysSo) {
    const Mesh mesh = cone(100, 0.5, true);
    CookSettings settings;
    settings.thickness = 0.04f;
    settings.thick_shell.measures_threshold = false;
    const Result<Model> model = cook(view_of(mesh), settings);
    ASSERT_TRUE(model.ok()) << model.error();
    EXPECT_NE(model->report().repairs.find("Thinned 2 fans of more than 64 triangles."), std::string::npos)
        << model->report().repairs;
}

}  // namespace
}  // namespace cullet
