#include "systems/cook/surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "engine/random.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet {
namespace {

Surface prepared(const Mesh& mesh) {
    Result<Surface> surface = prepare_surface(mesh);
    EXPECT_TRUE(surface) << surface.error();
    return surface ? *surface : Surface{};
}

// Neighbour links go both ways over the same edge, run in opposite senses, and every vertex has one fan.
void expect_consistent(const Surface& s) {
    std::vector<uint32_t> corners(s.positions.size()), links(s.positions.size()), borders(s.positions.size());
    for (uint32_t t = 0; t < s.triangles.size(); ++t)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = s.triangles[t][k], b = s.triangles[t][(k + 1) % 3];
            ++corners[a];
            const uint32_t other = s.neighbours[t][k];
            if (other == kNone) {
                ++borders[a], ++borders[b];
                continue;
            }
            ++links[a];
            bool is_mutual = false;
            for (uint32_t l = 0; l < 3; ++l)
                is_mutual = is_mutual || (s.neighbours[other][l] == t && s.triangles[other][l] == b &&
                                          s.triangles[other][(l + 1) % 3] == a);
            EXPECT_TRUE(is_mutual) << "triangle " << t << " edge " << k;
        }
    // A fan of n corners has n links when it closes; an open one has two borders, of which one leaves the vertex.
    for (uint32_t v = 0; v < s.positions.size(); ++v) {
        EXPECT_TRUE(borders[v] == 0 || borders[v] == 2) << "vertex " << v;
        EXPECT_EQ(links[v] + borders[v] / 2, corners[v]) << "vertex " << v;
    }
}

TEST(Surface, EveryCornerFindsItsSourceAgain) {
    Mesh mesh = test::turned_inside_out(test::sphere_mesh(1, 1));
    mesh = test::shuffled(mesh, 5);
    const Surface s = prepared(mesh);
    EXPECT_EQ(s.repairs.turned_components, 1u);
    EXPECT_NEAR(s.components[0].volume, 3.66, 0.02);
    for (size_t t = 0; t < s.triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t source = mesh.triangles[s.source_triangles[t]][s.source_corners[t][k]];
            EXPECT_TRUE(Vec3d(mesh.positions[source]) == s.positions[s.triangles[t][k]]);
        }
    expect_consistent(s);
}

TEST(Surface, IsTheSameForAnyNumbering) {
    const Mesh mesh = test::torus_mesh(1, 0.3, 12, 8);
    const Surface a = prepared(mesh);
    for (const uint64_t seed : {1ull, 2ull, 3ull}) {
        const Surface b = prepared(test::shuffled(mesh, seed));
        EXPECT_EQ(a.triangles, b.triangles);
        EXPECT_EQ(a.neighbours, b.neighbours);
        EXPECT_TRUE(std::equal(a.positions.begin(), a.positions.end(), b.positions.begin(), b.positions.end()));
    }
}

TEST(Surface, CleanMeshesNeedNoRepair) {
    for (const Mesh& mesh : {test::sphere_mesh(1, 2), test::box_mesh({1, 2, 3}, 3), test::torus_mesh(1, 0.3, 20, 10),
                             test::sheet_mesh(1, 1, 4, 4)}) {
        const Surface s = prepared(mesh);
        EXPECT_TRUE(s.repairs.is_clean()) << mesh.name << ": " << describe(s.repairs);
        EXPECT_EQ(s.components.size(), 1u);
        EXPECT_EQ(s.components[0].is_closed, mesh.name != "sheet");
        expect_consistent(s);
    }
    EXPECT_EQ(describe({}), "Surface: nothing to repair.");
}

TEST(Surface, TheBorderOfASheetIsOneLoopInWalkingOrder) {
    const Surface s = prepared(test::sheet_mesh(3, 2, 3, 2));
    ASSERT_EQ(s.border_loops.size(), 2u);
    ASSERT_EQ(s.border_edges.size(), 10u);
    for (size_t e = 0; e < 10; ++e) {
        const BorderEdge &here = s.border_edges[e], &next = s.border_edges[(e + 1) % 10];
        EXPECT_EQ(s.triangles[here.triangle][(here.edge + 1) % 3], s.triangles[next.triangle][next.edge]);
    }
}

TEST(Surface, DuplicateVerticesAreWeldedAndUnusedOnesDropped) {
    Mesh mesh = test::box_mesh({1, 1, 1}, 2);
    Mesh soup;
    for (const auto& t : mesh.triangles) {
        for (const uint32_t v : t) soup.positions.push_back(mesh.positions[v]);
        const uint32_t n = static_cast<uint32_t>(soup.positions.size());
        soup.triangles.push_back({n - 3, n - 2, n - 1});
    }
    soup.positions.push_back({9, 9, 9});
    soup.positions.push_back({-0.0f, 0, 0});  // equals (0, 0, 0)
    const Surface s = prepared(soup);
    EXPECT_EQ(s.positions.size(), mesh.positions.size());
    EXPECT_EQ(s.repairs.welded_vertices, soup.positions.size() - 1 - mesh.positions.size());
    EXPECT_EQ(s.repairs.unused_vertices, 1u);
    EXPECT_TRUE(s.components[0].is_closed);
}

TEST(Surface, TrianglesWithoutAreaAndRepeatedOnesAreDroppedAndCounted) {
    Mesh mesh = test::box_mesh({1, 1, 1}, 1);
    const auto t = mesh.triangles[3];
    mesh.triangles.push_back({t[1], t[2], t[0]});  // repeated
    mesh.triangles.push_back({t[1], t[0], t[2]});  // repeated, other winding
    mesh.triangles.push_back({t[0], t[0], t[1]});  // repeated corner
    mesh.positions.push_back({2, 2, 2});
    mesh.positions.push_back({2, 2, 2 + 1e-6f});
    mesh.positions.push_back({2, 2, 2 + 3e-6f});
    const uint32_t n = static_cast<uint32_t>(mesh.positions.size());
    mesh.triangles.push_back({n - 3, n - 2, n - 1});
    const Surface s = prepared(mesh);
    EXPECT_EQ(s.repairs.repeated_triangles, 2u);
    EXPECT_EQ(s.repairs.repeated_corner_triangles, 1u);
    EXPECT_EQ(s.repairs.zero_area_triangles, 1u);
    EXPECT_NE(describe(s.repairs).find("dropped 2 repeated triangles"), std::string::npos) << describe(s.repairs);
}

TEST(Surface, HalfTurnedTrianglesAreTurnedBack) {
    Mesh mesh = test::sphere_mesh(1, 2);
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
    const Surface s = prepared(mesh);
    EXPECT_EQ(s.repairs.turned_triangles, (mesh.triangles.size() + 2) / 3);
    EXPECT_GT(s.components[0].volume, 3.9);
    expect_consistent(s);
}

TEST(Surface, TheWallOfACavityKeepsItsWinding) {
    Mesh mesh = test::sphere_mesh(1, 2);
    test::append(mesh, test::turned_inside_out(test::sphere_mesh(0.6, 2)), {0.1, 0, 0});
    const Surface s = prepared(mesh);
    EXPECT_EQ(s.repairs.cavities, 1u);
    EXPECT_EQ(s.repairs.turned_components, 0u);
    EXPECT_TRUE(s.independent.empty());
}

TEST(Surface, BlocksThatTouchAndAreAllInsideOutAreAllTurned) {
    Mesh mesh;
    for (int x = 0; x < 3; ++x)
        for (int y = 0; y < 3; ++y) test::append(mesh, test::box_mesh({1, 1, 1}, 2), {1.0 * x, 1.0 * y, 0.25 * x});
    const Surface s = prepared(test::turned_inside_out(mesh));
    EXPECT_EQ(s.repairs.cavities, 0u) << describe(s.repairs);
    for (const SurfaceComponent& c : s.components) EXPECT_TRUE(!c.is_closed || c.volume > 0);
}

TEST(Surface, ABowTieVertexIsSplitIntoItsFans) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 1, 1}, {1, -1, 1}, {1, 0, -1}, {-1, 1, 1}, {-1, -1, 1}, {-1, 0, -1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}, {0, 5, 4}, {0, 6, 5}, {0, 4, 6}, {4, 5, 6}};
    const Surface s = prepared(mesh);
    EXPECT_EQ(s.repairs.split_vertices, 1u);
    EXPECT_EQ(s.positions.size(), 8u);
    EXPECT_EQ(s.position_count, 7u);
    EXPECT_EQ(s.components.size(), 2u);
    EXPECT_EQ(s.repairs.independent_pairs, 1u);
    EXPECT_TRUE(s.are_independent(0, 1) && s.are_independent(1, 0));
    expect_consistent(s);
}

TEST(Surface, TwoCubesThatShareAnEdgeAreTwoClosedBodies) {
    Mesh mesh = test::box_mesh({1, 1, 1}, 1);
    test::append(mesh, test::box_mesh({1, 1, 1}, 1), {1, 1, 0});
    const Surface s = prepared(mesh);
    EXPECT_EQ(s.repairs.crowded_edges, 1u);
    EXPECT_EQ(s.repairs.loose_sheets, 0u);
    ASSERT_EQ(s.components.size(), 2u);
    EXPECT_TRUE(s.components[0].is_closed && s.components[1].is_closed);
    EXPECT_NEAR(s.components[0].volume, 1, 1e-12);
    EXPECT_NEAR(s.components[1].volume, 1, 1e-12);
    EXPECT_TRUE(s.are_independent(0, 1));
    expect_consistent(s);
}

TEST(Surface, AFinOnACubeIsASheetOfItsOwnAndTheCubeStaysClosed) {
    Mesh mesh = test::box_mesh({1, 1, 1}, 1);
    const auto find = [&](Vec3 p) {
        for (uint32_t v = 0; v < mesh.positions.size(); ++v)
            if (mesh.positions[v] == p) return v;
        return kNone;
    };
    const uint32_t a = find({1, 1, 0}), b = find({1, 1, 1});
    mesh.positions.push_back({2, 2, 0.5f});
    mesh.triangles.push_back({a, b, static_cast<uint32_t>(mesh.positions.size() - 1)});
    const Surface s = prepared(mesh);
    EXPECT_EQ(s.repairs.crowded_edges, 1u);
    EXPECT_EQ(s.repairs.loose_sheets, 1u);
    ASSERT_EQ(s.components.size(), 2u);
    EXPECT_TRUE(s.components[0].is_closed);
    EXPECT_FALSE(s.components[1].is_closed);
    expect_consistent(s);
}

TEST(Surface, AMoebiusStripIsCalledOneSided) {
    const Mesh strip = test::grid_mesh(41, 4, false, false, [](uint32_t i, uint32_t j) {
        const double u = 2 * test::kPi * (i % 40) / 40, w = (j - 1.5) * 0.2 * (i == 40 ? -1 : 1);
        const double r = 1 + w * std::cos(u / 2);
        return Vec3d(r * std::cos(u), r * std::sin(u), w * std::sin(u / 2));
    });
    const Surface s = prepared(strip);
    EXPECT_EQ(s.components.size(), 1u);
    EXPECT_EQ(s.repairs.unorientable_components, 1u) << describe(s.repairs);
    EXPECT_FALSE(s.components[0].is_orientable);
}

TEST(Surface, CrossingTrianglesAreFoundAsByABruteForceCount) {
    // Two unit cubes, one moved by (0.5, 0.45, 0.4): the surfaces cross along a closed line, and nothing else touches.
    Mesh mesh = test::box_mesh({1, 1, 1}, 3);
    test::append(mesh, test::box_mesh({1, 1, 1}, 3), {0.5, 0.45, 0.4});
    const Surface s = prepared(mesh);
    ASSERT_EQ(s.components.size(), 2u);
    EXPECT_TRUE(s.are_independent(0, 1));
    size_t expected = 0;
    for (uint32_t a = 0; a < s.triangles.size(); ++a)
        for (uint32_t b = a + 1; b < s.triangles.size(); ++b) {
            if (s.component_of[a] == s.component_of[b]) continue;
            // In general position two triangles cross when an edge of one passes through the other.
            const auto passes = [&](const Triangle& t, const Triangle& u) {
                const auto volume = [&](Vec3d o, Vec3d p, Vec3d q, Vec3d r) { return dot(p - o, cross(q - o, r - o)); };
                for (size_t k = 0; k < 3; ++k) {
                    const Vec3d p = s.positions[t[k]], q = s.positions[t[(k + 1) % 3]];
                    const Vec3d x = s.positions[u[0]], y = s.positions[u[1]], z = s.positions[u[2]];
                    const double i = volume(p, q, x, y), j = volume(p, q, y, z), l = volume(p, q, z, x);
                    if (volume(x, y, z, p) * volume(x, y, z, q) < 0 &&
                        ((i > 0 && j > 0 && l > 0) || (i < 0 && j < 0 && l < 0)))
                        return true;
                }
                return false;
            };
            expected += passes(s.triangles[a], s.triangles[b]) || passes(s.triangles[b], s.triangles[a]);
        }
    EXPECT_EQ(s.crossings.size(), expected);
    EXPECT_GT(expected, 10u);
}

TEST(Surface, ASoupInWhichAllCutEachOtherIsRefusedAtOnce) {
    Mesh soup;
    const Random random{5};
    for (uint32_t v = 0; v < 3 * 6000; ++v) {
        const auto at = [&](uint32_t k) { return static_cast<float>(random.uniform(v, k)); };
        soup.positions.push_back({at(0), at(1), at(2)});
        if (v % 3 == 2) soup.triangles.push_back({v - 2, v - 1, v});
    }
    const Result<Surface> refused = prepare_surface(soup);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().find("pairs of its 6000 triangles cut or touch each other"), std::string::npos)
        << refused.error();
}

TEST(Surface, ASoupWithNoiseIsCalledSoAndHealedByATolerance) {
    const Mesh sphere = test::sphere_mesh(1, 2);
    Mesh soup;
    for (size_t t = 0; t < sphere.triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            Vec3 p = sphere.positions[sphere.triangles[t][k]];
            p.x += 1e-7f * static_cast<float>((t + k) % 3);
            soup.positions.push_back(p);
            if (k == 2) {
                const uint32_t n = static_cast<uint32_t>(soup.positions.size());
                soup.triangles.push_back({n - 3, n - 2, n - 1});
            }
        }
    const Surface loose = prepared(soup);
    EXPECT_TRUE(loose.repairs.is_mostly_border);
    EXPECT_NE(describe(loose.repairs).find("weld_tolerance"), std::string::npos);
    const Result<Surface> healed = prepare_surface(soup, {1e-6, true});
    ASSERT_TRUE(healed);
    EXPECT_EQ(healed->positions.size(), sphere.positions.size());
    EXPECT_EQ(healed->repairs.welded_vertices, soup.positions.size() - sphere.positions.size());
    EXPECT_EQ(healed->repairs.unused_vertices, 0u);
    EXPECT_TRUE(healed->components[0].is_closed);
    EXPECT_FALSE(prepare_surface(soup, {-1, true}));
    EXPECT_FALSE(prepare_surface(soup, {0.5, true}));
}

TEST(Surface, BadInputIsRefusedWithTheIndexOfTheCulprit) {
    Mesh mesh = test::box_mesh({1, 1, 1}, 1);
    mesh.name = "crate";
    mesh.positions[5].y = std::numeric_limits<float>::quiet_NaN();
    Result<Surface> s = prepare_surface(mesh);
    ASSERT_FALSE(s);
    EXPECT_NE(s.error().find("vertex 5"), std::string::npos) << s.error();
    EXPECT_NE(s.error().find("crate"), std::string::npos) << s.error();
    mesh.positions[5].y = std::numeric_limits<float>::infinity();
    EXPECT_FALSE(prepare_surface(mesh));
    mesh = test::box_mesh({1, 1, 1}, 1);
    mesh.triangles[2][1] = 99;
    s = prepare_surface(mesh);
    ASSERT_FALSE(s);
    EXPECT_NE(s.error().find("triangle 2 names vertex 99"), std::string::npos) << s.error();
    mesh = test::box_mesh({1, 1, 1}, 1);
    mesh.corner_uvs.resize(5);
    EXPECT_FALSE(prepare_surface(mesh));
    EXPECT_FALSE(prepare_surface(Mesh{}));
}

}  // namespace
}  // namespace cullet
