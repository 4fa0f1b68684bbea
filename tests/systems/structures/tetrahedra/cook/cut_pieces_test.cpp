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
