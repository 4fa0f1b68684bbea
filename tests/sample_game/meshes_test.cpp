#include "sample_game/meshes.hpp"

#include <gtest/gtest.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "engine/math.hpp"
#include "engine/mesh_file.hpp"
#include "sample_game/mesh_tools.hpp"

namespace cullet {
namespace {

/// Counted from the definition, edge by edge.
struct Facts {
    size_t edges = 0, wrong_edges = 0, border_edges = 0, border_loops = 0;
    double mean_edge = 0, area = 0, volume = 0, share_above_20_degrees = 0, least_degrees = 180;
    long euler = 0;
};

double degrees_at(Vec3d a, Vec3d b, Vec3d c) {
    return std::acos(std::clamp(dot(normalised(b - a), normalised(c - a)), -1.0, 1.0)) * 180 / 3.14159265358979;
}

/// Loops are followed along border edges; a vertex where two loops touch would be a wrong edge count of its own.
size_t loops_of(const std::map<uint32_t, uint32_t>& next) {
    std::set<uint32_t> seen;
    size_t loops = 0;
    for (const auto& [start, ignored] : next) {
        if (seen.count(start)) continue;
        ++loops;
        for (uint32_t v = start; next.count(v) && seen.insert(v).second;) v = next.at(v);
    }
    return loops;
}

Facts facts_of(const Mesh& mesh) {
    Facts facts;
    std::map<std::pair<uint32_t, uint32_t>, int> directed;
    size_t above = 0;
    for (const auto& t : mesh.triangles) {
        Vec3d p[3];
        double least = 180;
        for (int c = 0; c < 3; ++c) p[c] = Vec3d(mesh.positions[t[c]]);
        for (int c = 0; c < 3; ++c) {
            ++directed[{t[c], t[(c + 1) % 3]}];
            least = std::min(least, degrees_at(p[c], p[(c + 1) % 3], p[(c + 2) % 3]));
        }
        facts.area += 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
        facts.volume += dot(p[0], cross(p[1], p[2])) / 6;
        facts.least_degrees = std::min(facts.least_degrees, least);
        above += least > 20;
    }
    std::map<uint32_t, uint32_t> border;
    for (const auto& [edge, count] : directed) {
        const bool has_twin = directed.count({edge.second, edge.first}) > 0;
        if (count != 1 || edge.first == edge.second) ++facts.wrong_edges;
        if (!has_twin) {
            ++facts.border_edges;
            if (!border.emplace(edge.first, edge.second).second) ++facts.wrong_edges;
        }
        if (has_twin && edge.first > edge.second) continue;
        ++facts.edges;
        facts.mean_edge += length(Vec3d(mesh.positions[edge.first]) - Vec3d(mesh.positions[edge.second]));
    }
    facts.mean_edge /= static_cast<double>(facts.edges);
    facts.border_loops = loops_of(border);
    facts.share_above_20_degrees = static_cast<double>(above) / static_cast<double>(mesh.triangles.size());
    facts.euler = static_cast<long>(mesh.positions.size()) - static_cast<long>(facts.edges) +
                  static_cast<long>(mesh.triangles.size());
    return facts;
}

/// Sphere (2) less one for each loop: connected, no handle, no vertex where fans meet only in a point.
void expect_good(const Mesh& mesh, double edge, size_t vertices, size_t loops) {
    SCOPED_TRACE(mesh.name);
    const auto valid = validate_mesh(mesh, mesh.name);
    EXPECT_TRUE(valid.ok()) << valid.error();
    const Facts facts = facts_of(mesh);
    EXPECT_EQ(facts.wrong_edges, 0u);
    EXPECT_EQ(facts.border_loops, loops);
    EXPECT_EQ(facts.euler, 2 - static_cast<long>(loops));
    EXPECT_NEAR(facts.mean_edge, edge, 0.1 * edge);
    EXPECT_GT(facts.share_above_20_degrees, 0.99);
    EXPECT_GT(facts.least_degrees, 10);
    EXPECT_NEAR(static_cast<double>(mesh.positions.size()), static_cast<double>(vertices),
                0.08 * static_cast<double>(vertices));
}

TEST(Meshes, AVaseIsOneSheetOfNearEquilateralTrianglesWithOneOpenLip) {
    expect_good(make_vase(), 0.0075, 3200, 1);
    expect_good(make_vase(0.30f, 0.00405f), 0.00405, 11000, 1);
    expect_good(make_vase(0.30f, 0.00136f), 0.00136, 98000, 1);
    for (uint64_t seed = 2; seed < 12; ++seed) expect_good(make_vase(0.30f, 0.0075f, seed), 0.0075, 3200, 1);
}

TEST(Meshes, AVaseOfFiveMillimetresOfPorcelainWeighsTwoKilograms) {
    EXPECT_NEAR(facts_of(make_vase()).area * 0.005 * 2400, 2.0, 0.15);
}

TEST(Meshes, AVaseStandsOnItsFootAndLooksOutward) {
    const Mesh vase = make_vase();
    float low = 1, high = 0, widest = 0;
    for (const Vec3 p : vase.positions) {
        low = std::min(low, p.y);
        high = std::max(high, p.y);
        widest = std::max(widest, p.x * p.x + p.z * p.z);
    }
    EXPECT_FLOAT_EQ(low, 0);
    EXPECT_FLOAT_EQ(high, 0.3f);
    EXPECT_NEAR(std::sqrt(widest), 0.098, 0.002);
    // The first triangle lies in the foot; its outside is down.
    const auto& t = vase.triangles[0];
    EXPECT_LT(cross(vase.positions[t[1]] - vase.positions[t[0]], vase.positions[t[2]] - vase.positions[t[0]]).y, 0);
}

TEST(Meshes, EveryTriangleOfALatheLooksAwayFromItsAxisOrAlongIt) {
    // n . (outward normal of the meridian) > 0; on the belly that is the radius.
    const Mesh vase = make_vase();
    for (const auto& t : vase.triangles) {
        const Vec3 a = vase.positions[t[0]], b = vase.positions[t[1]], c = vase.positions[t[2]];
        const Vec3 middle = (1.0f / 3) * (a + b + c);
        if (middle.y < 0.03f || middle.y > 0.22f) continue;
        const Vec3 radius = normalised(Vec3{middle.x, 0, middle.z});
        EXPECT_GT(dot(normalised(cross(b - a, c - a)), radius), 0.5f);
    }
}

TEST(Meshes, SheetsHaveStraightBordersAndTheirExactArea) {
    expect_good(make_wall(), 0.078, 820, 1);
    expect_good(make_pane(), 0.010, 2900, 1);
    const Mesh wall = make_wall();
    const Facts facts = facts_of(wall);
    EXPECT_NEAR(facts.area, 2.4 * 1.8, 1e-5);
    size_t corners = 0;
    for (const Vec3 p : wall.positions) {
        EXPECT_EQ(p.z, 0);
        EXPECT_LE(std::fabs(p.x), 1.2f);
        EXPECT_GE(p.y, 0);
        EXPECT_LE(p.y, 1.8f);
        corners += std::fabs(p.x) == 1.2f && (p.y == 0 || p.y == 1.8f);
    }
    EXPECT_EQ(corners, 4u);
    for (const auto& t : wall.triangles)
        EXPECT_GT(cross(wall.positions[t[1]] - wall.positions[t[0]], wall.positions[t[2]] - wall.positions[t[0]]).z, 0);
}

TEST(Meshes, APiggyBankIsClosedHasNoHandleAndStandsOnTheFloor) {
    const Mesh pig = make_piggy_bank();
    expect_good(pig, 0.0098, 3000, 0);
    EXPECT_GT(facts_of(pig).volume, 0.005);
    float low = 1, left = 1, right = -1;
    for (const Vec3 p : pig.positions) {
        low = std::min(low, p.y);
        left = std::min(left, p.x);
        right = std::max(right, p.x);
    }
    EXPECT_FLOAT_EQ(low, 0);
    EXPECT_NEAR(right - left, 0.40, 1e-6);
    expect_good(make_piggy_bank(0.40f, 0.0098f, 2), 0.0098, 3000, 0);
    expect_good(make_piggy_bank(0.20f, 0.0098f), 0.0098, 750, 0);
    expect_good(make_piggy_bank(0.40f, 0.005f), 0.005, 11500, 0);
}

TEST(Meshes, ABallsVerticesLieOnItsSphere) {
    for (int n = 0; n <= 4; ++n) {
        const Mesh ball = make_ball(0.25f, n);
        EXPECT_EQ(ball.positions.size(), (10u << (2 * n)) + 2);
        for (const Vec3 p : ball.positions) EXPECT_NEAR(length(p), 0.25f, 1e-7f);
        const Facts facts = facts_of(ball);
        EXPECT_EQ(facts.wrong_edges, 0u);
        EXPECT_EQ(facts.border_edges, 0u);
        EXPECT_EQ(facts.euler, 2);
    }
    EXPECT_NEAR(facts_of(make_ball(0.25f, 4)).volume, 4.18879 * 0.25 * 0.25 * 0.25, 2e-4);
}

TEST(Meshes, ABoxAndATableHaveTheVolumesOfTheirParts) {
    const Facts box = facts_of(make_box({1, 2, 3}));
    EXPECT_EQ(box.wrong_edges + box.border_edges, 0u);
    EXPECT_DOUBLE_EQ(box.volume, 48);
    const Facts table = facts_of(make_table(1.2f, 0.8f, 0.75f));
    EXPECT_EQ(table.wrong_edges + table.border_edges, 0u);
    EXPECT_NEAR(table.volume, 1.2 * 0.8 * 0.04 + 4 * 0.06 * 0.06 * 0.71, 1e-6);
}

TEST(Meshes, TheSameArgumentsGiveTheSameBytesAndAnotherSeedOthers) {
    EXPECT_EQ(encode_mesh_file(make_vase()), encode_mesh_file(make_vase()));
    EXPECT_EQ(encode_mesh_file(make_pane()), encode_mesh_file(make_pane()));
    EXPECT_EQ(encode_mesh_file(make_piggy_bank()), encode_mesh_file(make_piggy_bank()));
    EXPECT_NE(encode_mesh_file(make_vase(0.30f, 0.0075f, 1)), encode_mesh_file(make_vase(0.30f, 0.0075f, 2)));
    EXPECT_NE(encode_mesh_file(make_piggy_bank(0.4f, 0.0098f, 1)), encode_mesh_file(make_piggy_bank(0.4f, 0.0098f, 2)));
}

TEST(Meshes, EveryCompilerAndMachineGivesTheseBytes) {
    // Goldens: changed on purpose, alone, when a shape is changed.
    const auto hash = [](const Mesh& mesh) {
        const auto bytes = encode_mesh_file(mesh);
        return static_cast<uint64_t>(XXH3_64bits(bytes.data(), bytes.size()));
    };
    EXPECT_EQ(hash(make_vase()), 0xd7ff7b285d30f525u);
    EXPECT_EQ(hash(make_piggy_bank()), 0x8a121657e853857au);
    EXPECT_EQ(hash(make_wall()), 0xb07bc6908e2d79c0u);
    EXPECT_EQ(hash(make_pane()), 0xf170b0c51a924419u);
    EXPECT_EQ(hash(make_ball(0.1f, 3)), 0xb5e435214ae592c8u);
}

TEST(Meshes, CoarseEdgesGiveCoarseShapesAndNoFault) {
    for (const Mesh& mesh : {make_vase(0.30f, 0.2f), make_wall(1, 1, 5), make_pane(0.5f, 0.5f)}) {
        SCOPED_TRACE(mesh.name);
        EXPECT_TRUE(validate_mesh(mesh, mesh.name).ok());
        EXPECT_EQ(facts_of(mesh).wrong_edges, 0u);
        EXPECT_EQ(facts_of(mesh).border_loops, 1u);
    }
    EXPECT_EQ(facts_of(make_piggy_bank(0.4f, 0.05f)).border_edges, 0u);
    EXPECT_EQ(facts_of(make_pane(0.5f, std::numeric_limits<float>::quiet_NaN())).border_loops, 1u);
}

TEST(MeshTools, JitterIsEvenlySpreadOverItsRange) {
    double sum = 0, squares = 0;
    constexpr int n = 100000;
    for (int i = 0; i < n; ++i) {
        const double x = jitter(7, 1, static_cast<uint64_t>(i), 0);
        EXPECT_GE(x, -1);
        EXPECT_LT(x, 1);
        sum += x;
        squares += x * x;
    }
    EXPECT_NEAR(sum / n, 0, 0.01);
    EXPECT_NEAR(squares / n, 1.0 / 3, 0.01);
}

TEST(MeshTools, FlippingLeavesNoEdgeWhoseOppositeAnglesSumToMoreThanPi) {
    // Two triangles over the long diagonal of a kite: the flip must take the short one.
    MeshDraft kite;
    kite.points = {{-2, 0, 0}, {2, 0, 0}, {0, 0.5, 0}, {0, -0.5, 0}};
    kite.triangles = {{0, 1, 2}, {1, 0, 3}};
    flip_to_delaunay(kite);
    for (const Triangle& t : kite.triangles)
        EXPECT_EQ(std::count(t.begin(), t.end(), 2u) + std::count(t.begin(), t.end(), 3u), 2);
}

TEST(MeshTools, FlippingATetrahedronChangesNothing) {
    MeshDraft flat;
    flat.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0.01}};
    flat.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const auto before = flat.triangles;
    flip_to_delaunay(flat);
    EXPECT_EQ(flat.triangles, before);
}

TEST(MeshTools, MarchingTetrahedraOfASphereAreClosedAndOutward) {
    const MeshDraft sphere =
        surface_of([](Vec3d p) { return length(p) - 1; }, {-1.3, -1.3, -1.3}, {1.3, 1.3, 1.3}, 0.1);
    const Facts facts = facts_of(to_mesh(sphere, "sphere"));
    EXPECT_EQ(facts.wrong_edges + facts.border_edges, 0u);
    EXPECT_EQ(facts.euler, 2);
    EXPECT_NEAR(facts.volume, 4.18879, 0.05);
}

}  // namespace
}  // namespace cullet
