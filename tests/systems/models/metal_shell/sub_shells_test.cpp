// Segmentation: metal shell note, section 3 and 15.
#include "systems/models/metal_shell/cook/sub_shells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/simple_meshes.hpp"
#include "tests/systems/models/metal_shell/panels.hpp"

namespace cullet {
namespace {

Surface surface_of(const Mesh& mesh) {
    const Result<Surface> made = prepare_surface(mesh);
    if (!made) ADD_FAILURE() << made.error(), std::abort();
    return *made;
}

/// Two unit right triangles that share their longest side, folded by an angle.
Surface folded(double angle) {
    Mesh mesh;
    mesh.positions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
    // The other corner at angle 0 is (1, 1, 0); it turns about the shared side.
    const double half = std::sqrt(0.5);
    const Vec3d middle(0.5, 0.5, 0), out(half, half, 0);
    double sine, cosine;
    sine_cosine(angle, sine, cosine);
    const Vec3d corner = middle + half * (cosine * out + sine * Vec3d(0, 0, 1));
    mesh.positions.push_back(corner.to_float());
    mesh.triangles = {{2, 0, 1}, {3, 1, 0}};
    return surface_of(mesh);
}

double only_distance(const Surface& surface, FaceDistance kind) {
    DualSettings settings;
    settings.distance = kind;
    settings.link_distance = 0;
    const DualGraph graph = build_dual_graph(surface, settings);
    EXPECT_EQ(graph.edges.size(), 2u);
    return graph.edges[0].distance;
}

TEST(FaceDistance, OfTwoRightTrianglesIsThatOfTheNote) {
    // Each centroid is a third of the height over the shared side away from its middle.
    const double way = 2 * std::sqrt(0.5) / 3;
    EXPECT_NEAR(only_distance(folded(test::kPi / 2), FaceDistance::Paper), 0.5 + 0.5 * way, 1e-6);
    // A hem that is folded back counts as flat there, and as twice the mean in ours.
    EXPECT_NEAR(only_distance(folded(0.999 * test::kPi), FaceDistance::Paper), 0.5 * way, 1e-4);
    EXPECT_NEAR(only_distance(folded(test::kPi / 2), FaceDistance::Normalised), 1, 1e-6);
}

TEST(SubShells, ASquareOfFourSeedsGivesFourEqualCells) {
    const Surface surface = surface_of(metal_sheet(1, 1, 16, 16));
    SubShellSettings settings;
    settings.count = 4;
    const Segmentation cells = find_sub_shells(surface, build_dual_graph(surface), settings);
    ASSERT_EQ(cells.count(), 4u);
    std::vector<uint32_t> sizes(4);
    for (const uint16_t cell : cells.cell_of) ++sizes[cell];
    for (const uint32_t size : sizes) EXPECT_NEAR(size, 128, 24);
}

bool is_connected(const DualGraph& graph, const Segmentation& cells, uint16_t cell) {
    std::vector<uint32_t> stack{cells.representative[cell]};
    std::set<uint32_t> seen{stack[0]};
    while (!stack.empty()) {
        const uint32_t face = stack.back();
        stack.pop_back();
        for (const DualEdge& edge : graph.of(face))
            if (cells.cell_of[edge.face] == cell && seen.insert(edge.face).second) stack.push_back(edge.face);
    }
    return seen.size() == static_cast<size_t>(std::count(cells.cell_of.begin(), cells.cell_of.end(), cell));
}

TEST(SubShells, EveryFaceIsInOneConnectedCellAndTheSumNeverRises) {
    for (const Mesh& mesh : {test::sphere_mesh(1, 4), test::box_mesh({1, 2, 3}, 12), metal_sheet(3, 1, 60, 20)}) {
        const Surface surface = surface_of(mesh);
        const DualGraph graph = build_dual_graph(surface);
        for (const Representatives rule : {Representatives::CentroidThenExact, Representatives::Exact}) {
            SubShellSettings settings;
            settings.count = 24;
            settings.representatives = rule;
            const Segmentation cells = find_sub_shells(surface, graph, settings);
            EXPECT_GE(cells.count(), 20u);
            EXPECT_LE(cells.count(), 24u);
            for (uint16_t cell = 0; cell < cells.count(); ++cell)
                EXPECT_TRUE(is_connected(graph, cells, cell)) << mesh.name << " " << cell;
            for (size_t round = 1; round < cells.sums.size(); ++round)
                EXPECT_LE(cells.sums[round], cells.sums[round - 1] * (1 + 1e-12)) << round;
            EXPECT_GT(cells.sums.size(), 1u);
        }
    }
}

TEST(SubShells, FarthestSeedsCoverBetterThanThoseOfThePaper) {
    const Surface surface = surface_of(metal_sheet(1.2, 0.8, 60, 45));
    const DualGraph graph = build_dual_graph(surface);
    SubShellSettings ours, paper;
    ours.count = paper.count = 40;
    ours.rounds = paper.rounds = 0;
    paper.seeding = Seeding::Paper;
    const Segmentation a = find_sub_shells(surface, graph, ours), b = find_sub_shells(surface, graph, paper);
    EXPECT_LT(2 * a.radius, b.radius);
    EXPECT_LT(2 * a.sums[0], b.sums[0]);
}

TEST(SubShells, AThresholdFindsHowManyAreNeeded) {
    const Surface surface = surface_of(metal_sheet(1, 1, 40, 40));
    const DualGraph graph = build_dual_graph(surface);
    SubShellSettings settings;
    settings.count = kMostSubShells;
    settings.threshold = 12;
    settings.rounds = 0;
    const Segmentation cells = find_sub_shells(surface, graph, settings);
    EXPECT_LE(cells.radius, 12);
    EXPECT_GT(cells.count(), 4u);
    EXPECT_LT(cells.count(), 200u);
}

TEST(SubShells, SheetsThatLieOnEachOtherShareCellsAndThoseApartDoNot) {
    Mesh mesh = metal_sheet(1, 1, 20, 20);
    test::append(mesh, metal_sheet(1, 1, 20, 20), {0, 0, 0.005});
    test::append(mesh, metal_sheet(1, 1, 20, 20), {0, 0, 0.5});
    const Surface surface = surface_of(mesh);
    const DualGraph graph = build_dual_graph(surface);
    EXPECT_EQ(graph.component_count, 2u);
    EXPECT_GE(graph.links.size(), 400u);
    for (const SheetLink& link : graph.links) EXPECT_NEAR(link.gap, 0.005, 1e-6);
}

TEST(SubShells, RenumberedTrianglesGiveTheSameCells) {
    const Mesh mesh = test::sphere_mesh(1, 3);
    const Surface a = surface_of(mesh), b = surface_of(test::shuffled(mesh, 5));
    ASSERT_EQ(a.triangles.size(), b.triangles.size());
    SubShellSettings settings;
    settings.count = 16;
    const Segmentation first = find_sub_shells(a, build_dual_graph(a), settings),
                       second = find_sub_shells(b, build_dual_graph(b), settings);
    EXPECT_EQ(first.cell_of, second.cell_of);  // surfaces stand in an order of their own
}

}  // namespace
}  // namespace cullet
