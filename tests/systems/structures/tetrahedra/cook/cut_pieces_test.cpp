// Skins of pieces: solid cooking note, section 10, T4 and T11.
#include "systems/structures/tetrahedra/cook/cut_pieces.hpp"

#include <gtest/gtest.h>

#include <map>

#include "engine/random.hpp"
#include "engine/table.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet {
namespace {

CookedSolid cooked(const Mesh& mesh) {
    Result<CookedSolid> made = cook_solid(mesh);
    if (!made) ADD_FAILURE() << made.error(), std::abort();
    return std::move(made).value();
}

uint32_t odd_edges(const PieceSkin& skin) {
    std::map<std::pair<uint32_t, uint32_t>, int> balance;
    for (const PieceTriangle& t : skin.triangles)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = t.corners[k], b = t.corners[(k + 1) % 3];
            balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    uint32_t odd = 0;
    for (const auto& [edge, sum] : balance) odd += sum != 0;
    return odd;
}

double volume_of(const PieceSkin& skin) {
    double six = 0;
    for (const PieceTriangle& t : skin.triangles)
        six += dot(skin.places[t.corners[0]], cross(skin.places[t.corners[1]], skin.places[t.corners[2]]));
    return six / 6;
}

List<PieceSkin> pieces_of(const CookedSolid& solid, const std::vector<uint32_t>& labels, uint32_t count) {
    Result<List<PieceSkin>> made = cut_pieces(solid, {}, labels, count);
    if (!made) ADD_FAILURE() << made.error(), std::abort();
    return std::move(made).value();
}

TEST(CutPieces, OneOfAllIsTheMeshItself) {
    const CookedSolid solid = cooked(test::torus_mesh(0.3, 0.1, 64, 32));
    const auto skins = pieces_of(solid, std::vector<uint32_t>(solid.solid.cells.size(), 0), 1);
    ASSERT_EQ(skins[0].triangles.size(), solid.mesh.triangles.size());
    for (size_t t = 0; t < skins[0].triangles.size(); ++t) {
        ASSERT_EQ(skins[0].triangles[t].source, t);
        for (size_t k = 0; k < 3; ++k) {
            const Vec3d is = skins[0].places[skins[0].triangles[t].corners[k]],
                        was = solid.mesh.positions[solid.mesh.triangles[t][k]];
            EXPECT_TRUE(is.x == was.x && is.y == was.y && is.z == was.z);
        }
    }
}

TEST(CutPieces, HalvesAndAnyLabelsAreClosedAndHaveAllOfTheVolume) {
    for (const Mesh& mesh : {test::sphere_mesh(0.3, 3), test::box_mesh({0.5, 0.2, 0.2}, 2)}) {
        const CookedSolid solid = cooked(mesh);
        const Random random{5};
        for (const bool is_random : {false, true}) {
            std::vector<uint32_t> labels;
            for (uint32_t c = 0; c < solid.solid.cells.size(); ++c)
                labels.push_back(is_random ? static_cast<uint32_t>(random.uniform(c) * 7)
                                           : solid.solid.cells[c].centroid.x > 0.05);
            const uint32_t count = is_random ? 7 : 2;
            double sum = 0;
            for (const PieceSkin& skin : pieces_of(solid, labels, count)) {
                EXPECT_EQ(odd_edges(skin), 0u);
                EXPECT_GT(volume_of(skin), 0);
                sum += volume_of(skin);
            }
            EXPECT_NEAR(sum / solid.solid.volume, 1, 1e-5);
        }
    }
}

/// Labels by two planes and points near them moved, as cracks move them; the rim stays.
struct Broken {
    std::vector<uint32_t> labels;
    std::vector<Vec3d> points;
};
Broken broken_at(const CookedSolid& solid, double x, double z, bool has_lost) {
    const CoverLattice& lattice = solid.solid.lattice;
    Broken broken;
    broken.points = lattice.points;
    std::vector<uint8_t> is_rim(lattice.points.size());
    for (const LatticeFace& face : solid.faces.faces)
        if (face.tetrahedron[1] == kNone)
            for (const uint32_t p : face.corner) is_rim[p] = 1;
    const Random random{23};
    for (uint32_t p = 0; p < lattice.points.size(); ++p) {
        const Vec3d at = lattice.points[p];
        if (is_rim[p] || std::min(std::fabs(at.x - x), std::fabs(at.z - z)) > lattice.edge) continue;
        const auto shift = [&](uint64_t axis) { return (random.uniform(p, axis) - 0.5) * 2 / 7 * lattice.edge; };
        broken.points[p] += Vec3d(shift(0), shift(1), shift(2));
    }
    for (const SolidCell& cell : solid.solid.cells) {
        const uint32_t label = (cell.centroid.x > x) + 2 * (cell.centroid.z > z);
        broken.labels.push_back(has_lost && label == 3 ? kNone : label);
    }
    return broken;
}

/// Legs that stand in one tetrahedron, walls thinner than one, crossing parts, and one triangle over the whole body.
std::vector<Mesh> bodies_to_break() {
    std::vector<Mesh> meshes = {test::torus_mesh(0.3, 0.1, 64, 32), test::box_mesh({0.5, 0.2, 0.2}, 1),
                                test::box_mesh({0.5, 0.01, 0.4}, 8), test::sphere_mesh(0.3, 4)};
    Mesh crossing = test::sphere_mesh(0.3, 3);
    test::append(crossing, test::box_mesh({0.5, 0.2, 0.2}, 2), {0.1, -0.1, -0.05});
    meshes.push_back(crossing);
    return meshes;
}

TEST(CutPieces, NearTheCracksGivesWhatACutOfAllGivesToTheBit) {
    for (const Mesh& mesh : bodies_to_break())
        for (const bool has_lost : {false, true}) {
            const CookedSolid solid = cooked(mesh);
            const Broken broken = broken_at(solid, 0.05, -0.03, has_lost);
            const uint32_t count = has_lost ? 3 : 4;
            PieceCut near(solid, broken.points, broken.labels, count);
            double most = near.nanoseconds();
            while (!near.advance()) most = std::max(most, near.nanoseconds());
            ASSERT_EQ(near.error(), "");
            EXPECT_LT(most, 4e6);  // about as long as a step took, measured once
            const Result<List<PieceSkin>> all = cut_pieces(solid, broken.points, broken.labels, count, CutExtent::All);
            ASSERT_TRUE(all.ok());
            double sum = 0;
            for (uint32_t p = 0; p < count; ++p) {
                const PieceSkin a = near.skin_of(p);
                const PieceSkin& b = (*all)[p];
                EXPECT_EQ(odd_edges(a), 0u);
                ASSERT_EQ(a.places.size(), b.places.size());
                EXPECT_TRUE(std::equal(a.places.begin(), a.places.end(), b.places.begin()));
                ASSERT_EQ(a.triangles.size(), b.triangles.size());
                for (size_t t = 0; t < a.triangles.size(); ++t) {
                    ASSERT_EQ(a.triangles[t].corners, b.triangles[t].corners);
                    ASSERT_EQ(a.triangles[t].source, b.triangles[t].source);
                }
                sum += volume_of(a);
            }
            if (!has_lost) {
                EXPECT_NEAR(sum / solid.solid.volume, 1, 1e-5);
            }
            if (mesh.triangles.size() > 2000) {
                EXPECT_LT(near.cut_triangles(), mesh.triangles.size() / 3);
            }
        }
}

TEST(CutPieces, WhatLeftBeforeHasNoSkinAndItsNeighbourIsClosed) {
    const CookedSolid solid = cooked(test::sphere_mesh(0.3, 3));
    std::vector<uint32_t> labels;
    for (const SolidCell& cell : solid.solid.cells) labels.push_back(cell.centroid.x > 0.05 ? kNone : 0);
    const auto skins = pieces_of(solid, labels, 1);
    EXPECT_EQ(odd_edges(skins[0]), 0u);
    EXPECT_GT(volume_of(skins[0]), 0.5 * solid.solid.volume);
    EXPECT_LT(volume_of(skins[0]), 0.8 * solid.solid.volume);
}

}  // namespace
}  // namespace cullet
