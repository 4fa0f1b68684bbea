// Convex pieces of solids: solid cooking note, section 8.
#include "systems/structures/tetrahedra/cook/convex_pieces.hpp"

#include <gtest/gtest.h>

#include "engine/hash.hpp"
#include "systems/hulls/extreme_points.hpp"
#include "systems/structures/tetrahedra/cook/cook_solid.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet {
namespace {

struct Pieces {
    CookedSolid solid;
    List<SolidHull> list;
    double volume = 0, hull_volume = 0;
};

Pieces pieces_of(const Mesh& mesh, const HalvingSettings& settings = {}) {
    SolidSettings few;
    few.cells = 300;
    Result<CookedSolid> made = cook_solid(mesh, few);
    if (!made) ADD_FAILURE() << made.error(), std::abort();
    Pieces pieces;
    pieces.solid = std::move(made).value();
    ScratchMemory scratch;
    pieces.list = convex_pieces(scratch, pieces.solid.mesh.positions, pieces.solid.mesh.triangles, settings);
    for (const SolidHull& piece : pieces.list) pieces.volume += piece.volume, pieces.hull_volume += piece.hull_volume;
    return pieces;
}

/// Faces of a hull, and how far a point is out of it, m.
struct Faces {
    std::vector<std::array<Vec3, 2>> list;  // place, normal
    explicit Faces(const SolidHull& piece) {
        ScratchMemory scratch;
        ExtremePoints hull;
        choose_extremes(scratch, piece.points, kMostHullPoints, 1e-4f, hull);
        for (uint32_t f = 0; f < hull.face_count; ++f) {
            Vec3 c[3];
            for (uint32_t k = 0; k < 3; ++k) c[k] = piece.points[hull.index[hull.face[f][k]]];
            list.push_back({c[0], normalised(cross(c[1] - c[0], c[2] - c[0]))});
        }
    }
    double outside(Vec3 p) const {
        double most = -1e30;
        for (const auto& [place, normal] : list) most = std::max<double>(most, dot(normal, p - place));
        return most;
    }
};

/// The farthest that any point of the lattice within the solid is from all hulls.
double left_out(const Pieces& pieces) {
    std::vector<Faces> hulls;
    for (const SolidHull& piece : pieces.list) hulls.emplace_back(piece);
    double most = 0;
    for (uint32_t p = 0; p < pieces.solid.solid.lattice.points.size(); ++p) {
        if (pieces.solid.windings.of(p).empty()) continue;
        double nearest = 1e30;
        for (const Faces& hull : hulls)
            nearest = std::min(nearest, hull.outside(pieces.solid.solid.lattice.points[p].to_float()));
        most = std::max(most, nearest);
    }
    return most;
}

Mesh thick_angle() {
    // An L of 1 m, 0.4 m thick everywhere.
    const std::vector<Vec2> outline{{0, 0}, {1, 0}, {1, 0.4f}, {0.4f, 0.4f}, {0.4f, 1}, {0, 1}};
    Mesh mesh;
    mesh.name = "angle";
    for (const float z : {0.0f, 0.4f})
        for (const Vec2 p : outline) mesh.positions.push_back({p.x, p.y, z});
    const std::array<uint32_t, 3> face[4] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
    for (const auto& [a, b, c] : face) {
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({a + 6, b + 6, c + 6});
    }
    for (uint32_t k = 0; k < 6; ++k) {
        const uint32_t a = k, b = (k + 1) % 6;
        mesh.triangles.push_back({a, b, b + 6});
        mesh.triangles.push_back({a, b + 6, a + 6});
    }
    return mesh;
}

TEST(ConvexPieces, ABoxIsOneWithItsCorners) {
    const Pieces pieces = pieces_of(test::box_mesh({0.2, 0.1, 0.05}, 3));
    ASSERT_EQ(pieces.list.size(), 1u);
    EXPECT_EQ(pieces.list[0].points.size(), 8u);
    EXPECT_NEAR(pieces.list[0].hull_volume, 0.001, 1e-8);
    EXPECT_NEAR(pieces.list[0].volume, 0.001, 1e-8);
}

TEST(ConvexPieces, AnAngleFallsIntoFew) {
    const Pieces pieces = pieces_of(thick_angle());
    EXPECT_LE(pieces.list.size(), 4u);
    EXPECT_LE(pieces.hull_volume, 1.2 * pieces.solid.mesh.volume);
    EXPECT_NEAR(pieces.volume / pieces.solid.mesh.volume, 1, 1e-9);
    EXPECT_LT(left_out(pieces), 0.002);
}

// Cut by many planes, a corner between three of them within the solid is no point of the surface and must not be lost.
TEST(ConvexPieces, TheInsideIsNotLost) {
    HalvingSettings always;
    always.most_excess = 0;
    for (const Mesh& mesh : {test::box_mesh({1, 1, 1}, 2), thick_angle()}) {
        const Pieces pieces = pieces_of(mesh, always);
        EXPECT_GE(pieces.list.size(), 60u);
        EXPECT_NEAR(pieces.volume / pieces.solid.mesh.volume, 1, 1e-9);
        EXPECT_NEAR(pieces.hull_volume / pieces.solid.mesh.volume, 1, 0.002);
        EXPECT_LT(left_out(pieces), 1e-4);
    }
}

TEST(ConvexPieces, RingsAndCavitiesAreFollowed) {
    const Pieces ring = pieces_of(test::torus_mesh(1, 0.2, 48, 16));
    EXPECT_LT(ring.hull_volume, 1.25 * ring.solid.mesh.volume);
    EXPECT_NEAR(ring.volume / ring.solid.mesh.volume, 1, 1e-9);
    EXPECT_LT(left_out(ring), 0.02);

    Mesh hollow = test::sphere_mesh(1, 3);
    test::append(hollow, test::turned_inside_out(test::sphere_mesh(0.8, 3)));
    const Pieces shell = pieces_of(hollow);
    EXPECT_NEAR(shell.volume / shell.solid.mesh.volume, 1, 1e-9);
    EXPECT_LT(shell.hull_volume, 1.5 * shell.solid.mesh.volume);  // one hull would be twice the shell
    EXPECT_LT(left_out(shell), 0.02);
}

TEST(ConvexPieces, FarFromTheOriginTheyAreAsGood) {
    Mesh far;
    test::append(far, test::torus_mesh(1, 0.25, 32, 12), {1024, -512, 2048});
    const Pieces here = pieces_of(test::torus_mesh(1, 0.25, 32, 12)), there = pieces_of(far);
    // Its floats are coarser, so that it is another mesh and other cuts are as good.
    EXPECT_NEAR(there.volume / there.solid.mesh.volume, 1, 1e-9);
    EXPECT_NEAR(here.hull_volume, there.hull_volume, 0.02);
}

TEST(ConvexPieces, BytesAreTheSameEverywhere) {
    uint64_t hash = 0;
    Mesh mesh = test::sphere_mesh(1, 2);
    test::append(mesh, test::box_mesh({3, 0.25, 0.25}, 2), {0.1, 0, 0});
    for (const SolidHull& piece : pieces_of(mesh).list)
        for (const Vec3 p : piece.points) hash = hash_bytes(&p, sizeof p, hash);
    EXPECT_EQ(hash, 573275131950429562u);
}

}  // namespace
}  // namespace cullet
