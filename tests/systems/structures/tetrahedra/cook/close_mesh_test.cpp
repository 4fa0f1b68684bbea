// Which mesh is a solid: solid cooking note, section 3.
#include "systems/structures/tetrahedra/cook/closed_mesh.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "engine/table.hpp"
#include "systems/structures/tetrahedra/cook/cook_solid.hpp"
#include "tests/support/simple_meshes.hpp"
#include "tests/support/solid_checks.hpp"

namespace cullet {
namespace {

/// Every side has its pair, once forward and once back.
void expect_closed(const ClosedMesh& mesh) {
    std::vector<std::array<uint32_t, 2>> uses(mesh.pairs.size());
    ASSERT_EQ(mesh.sides.size(), mesh.triangles.size());
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (uint32_t k = 0; k < 3; ++k) {
            ASSERT_LT(mesh.sides[t][k], mesh.pairs.size());
            const auto [low, high] = mesh.pairs[mesh.sides[t][k]];
            const uint32_t from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
            EXPECT_TRUE((from == low && to == high) || (from == high && to == low));
            ++uses[mesh.sides[t][k]][from == low ? 0 : 1];
        }
    for (const auto& use : uses) EXPECT_TRUE(use[0] == 1 && use[1] == 1);
}

ClosedMesh closed(const Mesh& mesh) {
    const Result<ClosedMesh> made = close_mesh(mesh);
    if (!made) ADD_FAILURE() << made.error(), std::abort();
    expect_closed(*made);
    return *made;
}

std::string refusal_of(const Mesh& mesh) {
    const Result<ClosedMesh> made = close_mesh(mesh);
    return made ? "" : made.error();
}

Mesh without(Mesh mesh, const std::function<bool(Vec3)>& is_gone) {
    std::erase_if(mesh.triangles, [&](const auto& t) {
        return is_gone(1.0f / 3 * (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]));
    });
    return mesh;
}

TEST(CloseMesh, AClosedMeshStaysAsItIs) {
    const ClosedMesh mesh = closed(test::torus_mesh(2, 0.5, 24, 12));
    EXPECT_EQ(mesh.triangles.size(), 576u);
    EXPECT_EQ(mesh.holes, 0u);
    EXPECT_EQ(mesh.part_count, 1u);
    EXPECT_EQ(describe(mesh), "");
}

TEST(CloseMesh, ABoxWithoutABottomGetsOne) {
    const Mesh open = without(test::box_mesh({1, 2, 1}, 4), [](Vec3 p) { return p.y < 1e-6f; });
    const ClosedMesh mesh = closed(open);
    EXPECT_EQ(mesh.holes, 1u);
    EXPECT_NEAR(mesh.volume, 2, 1e-12);
    EXPECT_NEAR(mesh.area, 10, 1e-12);
    EXPECT_EQ(describe(mesh), "filled 1 hole (10 % of the surface)");
    uint32_t made = 0;
    for (const uint32_t source : mesh.source) made += source == kNone;
    EXPECT_EQ(made, 14u);  // of a loop of 16 edges
}

TEST(CloseMesh, HolesThatMeetInAPointAreTwo) {
    // Two squares of the side z = 1 that touch at a corner.
    const Mesh open = without(test::box_mesh({1, 1, 1}, 4), [](Vec3 p) {
        return p.z > 0.999f && ((p.x > 0.25f && p.x < 0.5f && p.y > 0.25f && p.y < 0.5f) ||
                                (p.x > 0.5f && p.x < 0.75f && p.y > 0.5f && p.y < 0.75f));
    });
    const ClosedMesh mesh = closed(open);
    EXPECT_EQ(mesh.holes, 2u);
    EXPECT_NEAR(mesh.volume, 1, 1e-12);
    EXPECT_NEAR(mesh.area, 6, 1e-12);
}

TEST(CloseMesh, TJunctionsAndDroppedTrianglesLeaveNoHole) {
    Mesh mesh = test::box_mesh({1, 1, 1}, 1);
    // One side gets a point in the middle of an edge that its neighbour has not.
    const auto [a, b, c] = mesh.triangles[0];
    const auto middle = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.push_back(0.5f * (mesh.positions[a] + mesh.positions[b]));
    mesh.triangles[0] = {a, middle, c};
    mesh.triangles.push_back({middle, b, c});
    const ClosedMesh made = closed(mesh);
    EXPECT_EQ(made.holes, 0u);
    EXPECT_NEAR(made.volume, 1, 1e-12);
    const Result<CookedSolid> solid = cook_solid(mesh);
    ASSERT_TRUE(solid) << solid.error();
    const test::SolidReport report = test::check_solid(*solid);
    EXPECT_TRUE(report.is_sound()) << report;
}

TEST(CloseMesh, WhatIsInsideOutIsTurned) {
    const ClosedMesh mesh = closed(test::turned_inside_out(test::box_mesh({1, 1, 1}, 2)));
    EXPECT_NEAR(mesh.volume, 1, 1e-12);
    // With an open bottom nobody knows before it is closed.
    const Mesh open = without(test::box_mesh({1, 2, 1}, 4), [](Vec3 p) { return p.y < 1e-6f; });
    EXPECT_NEAR(closed(test::turned_inside_out(open)).volume, 2, 1e-12);
}

TEST(CloseMesh, ACavityBelongsToThePartAroundIt) {
    Mesh mesh = test::box_mesh({1, 1, 1}, 2);
    test::append(mesh, test::turned_inside_out(test::box_mesh({0.5, 0.5, 0.5}, 1)), {0.25, 0.25, 0.25});
    test::append(mesh, test::box_mesh({0.25, 0.25, 0.25}, 1), {0.375, 0.375, 0.375});
    const ClosedMesh made = closed(mesh);
    EXPECT_EQ(made.part_count, 2u);  // the box with its cavity, and what lies loose in it
    EXPECT_NEAR(made.volume, 1 - 0.125 + 0.015625, 1e-12);
}

TEST(CloseMesh, RepeatedTrianglesCountOnce) {
    Mesh mesh = test::box_mesh({1, 1, 1}, 2);
    const auto first = mesh.triangles[3];
    mesh.triangles.push_back(first);
    mesh.triangles.push_back({first[2], first[1], first[0]});
    const ClosedMesh made = closed(mesh);
    EXPECT_EQ(made.triangles.size(), 48u);
    EXPECT_NEAR(made.volume, 1, 1e-12);
}

TEST(CloseMesh, WhatIsNoSolidSaysWhy) {
    Mesh half = without(test::sphere_mesh(1, 3), [](Vec3 p) { return p.y > -0.1f; });
    half.name = "half";
    const std::string holes = refusal_of(half);
    EXPECT_NE(holes.find("\"half\" is no solid: "), std::string::npos) << holes;
    EXPECT_NE(holes.find(" open edges, closing them would add "), std::string::npos) << holes;
    EXPECT_NE(holes.find(" % of new surface. Close it, or use the model thick_shell."), std::string::npos) << holes;

    Mesh sheet = test::sheet_mesh(1, 1, 4, 4);
    EXPECT_NE(refusal_of(sheet).find("is no solid"), std::string::npos);  // its hole is as large as it is

    // A sheet of two sides, and nothing between them.
    Mesh flat = test::grid_mesh(5, 5, false, false, [](uint32_t i, uint32_t j) { return Vec3d(i, j, 0); });
    const auto count = flat.triangles.size();
    for (size_t t = 0; t < count; ++t) {
        const auto [a, b, c] = flat.triangles[t];
        flat.triangles.push_back({a + 25, c + 25, b + 25});
    }
    for (uint32_t v = 0; v < 25; ++v) flat.positions.push_back(flat.positions[v] + Vec3{0, 0, 0});
    flat.name = "flat";
    EXPECT_NE(refusal_of(flat), "");

    Mesh broken = test::box_mesh({1, 1, 1}, 1);
    broken.positions[3].x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(refusal_of(broken).find("not finite"), std::string::npos);
}

TEST(CloseMesh, WhatHasOneSideEnclosesNothing) {
    // A tube that comes back into itself from the other side.
    const uint32_t around = 24, across = 12;
    Mesh klein;
    klein.name = "klein";
    for (uint32_t i = 0; i < around; ++i)
        for (uint32_t j = 0; j < across; ++j) {
            double s, c, sv, cv, sh, ch;
            sine_cosine(2 * test::kPi * i / around, s, c);
            sine_cosine(test::kPi * i / around, sh, ch);
            sine_cosine(2 * test::kPi * j / across, sv, cv);
            // The figure of eight of which it is often made would cross itself; turned by half it joins reversed.
            const double x = 0.3 * sv, y = 0.3 * 2 * sv * cv, r = 1 + ch * x - sh * y;
            klein.positions.push_back(Vec3d(r * c, r * s, sh * x + ch * y).to_float());
        }
    for (uint32_t i = 0; i < around; ++i)
        for (uint32_t j = 0; j < across; ++j) {
            const auto id = [&](uint32_t a, uint32_t b) {
                return a < around ? a * across + b % across : (across - b % across) % across;
            };
            klein.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
            klein.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
        }
    const std::string sentence = refusal_of(klein);
    EXPECT_NE(sentence.find("\"klein\" encloses no volume."), std::string::npos) << sentence;
}

TEST(CookSolid, WhatIsTooThinSaysHowManyCellsItNeeds) {
    Mesh mesh = test::box_mesh({2, 0.002, 2}, 1);
    mesh.name = "pane";
    const Result<CookedSolid> made = cook_solid(mesh);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error(),
              "\"pane\" is 0.002 m thick and 2.83 m long: a solid of it needs 467796 cells, above the limit of 20000. "
              "Use thick_shell, or raise lattice.most_cells.");
}

}  // namespace
}  // namespace cullet
