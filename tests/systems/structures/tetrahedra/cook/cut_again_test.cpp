// A break cuts again, where points of the lattice have moved: solid cooking note, sections 4 and 7.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/random.hpp"
#include "engine/table.hpp"
#include "systems/structures/tetrahedra/cook/cook_solid.hpp"
#include "systems/structures/tetrahedra/cook/cut_work.hpp"
#include "tests/support/simple_meshes.hpp"
#include "tests/support/solid_checks.hpp"

namespace cullet {
namespace {

CookedSolid cooked(const Mesh& mesh) {
    Result<CookedSolid> made = cook_solid(mesh);
    if (!made) ADD_FAILURE() << made.error(), std::abort();
    return std::move(made).value();
}

Mesh crossing_balls() {
    Mesh mesh = test::sphere_mesh(0.3, 3);
    test::append(mesh, test::box_mesh({0.5, 0.2, 0.2}, 2), {0.1, -0.1, -0.05});
    return mesh;
}

/// Points near a plane, moved by up to a seventh of a cell; none on the rim.
struct Moved {
    std::vector<Vec3d> points;
    std::vector<uint8_t> is_known;           // of points: those that stayed
    std::vector<uint32_t> tetrahedra;        // with a point that moved
    std::vector<uint32_t> faces, triangles;  // theirs
};

Moved move_points(const CookedSolid& solid) {
    const CoverLattice& lattice = solid.solid.lattice;
    Moved moved;
    moved.points = lattice.points;
    moved.is_known.assign(lattice.points.size(), 1);
    std::vector<uint8_t> is_rim(lattice.points.size());
    for (const LatticeFace& face : solid.faces.faces)
        if (face.tetrahedron[1] == kNone)
            for (const uint32_t p : face.corner) is_rim[p] = 1;
    const Random random{11};
    for (uint32_t p = 0; p < lattice.points.size(); ++p) {
        if (is_rim[p] || std::fabs(lattice.points[p].x - 0.2) > 1.5 * lattice.edge) continue;
        const auto shift = [&](uint64_t axis) { return (random.uniform(p, axis) - 0.5) * 2 / 7 * lattice.edge; };
        moved.points[p] += Vec3d(shift(0), shift(1), shift(2));
        moved.is_known[p] = 0;
    }
    std::vector<uint8_t> is_wanted(solid.faces.faces.size()), is_touched(lattice.fine.size());
    for (uint32_t t = 0; t < lattice.fine.size(); ++t) {
        for (const uint32_t p : lattice.fine[t]) is_touched[t] |= !moved.is_known[p];
        if (!is_touched[t]) continue;
        moved.tetrahedra.push_back(t);
        for (const uint32_t f : solid.faces.of[t]) is_wanted[f] = 1;
    }
    for (uint32_t f = 0; f < is_wanted.size(); ++f)
        if (is_wanted[f]) moved.faces.push_back(f);
    // What such tetrahedra fill together stays the same, so triangles that met them are all that meet them.
    const Result<Cut> before = cut_mesh({solid.mesh, lattice, solid.faces});
    if (!before) ADD_FAILURE() << before.error(), std::abort();
    for (const CutPolygon& p : before->polygons)
        if (is_touched[p.tetrahedron] && (moved.triangles.empty() || moved.triangles.back() != p.triangle))
            moved.triangles.push_back(p.triangle);
    return moved;
}

Cut cut_of(const CutRequest& request) {
    Result<Cut> cut = cut_mesh(request);
    if (!cut) ADD_FAILURE() << cut.error(), std::abort();
    return std::move(cut).value();
}

TEST(CutAgain, WithMovedPointsAllIsAsClosedAsBefore) {
    for (const Mesh& mesh : {crossing_balls(), test::torus_mesh(0.3, 0.1, 64, 32)}) {
        CookedSolid solid = cooked(mesh);
        const double volume = solid.solid.volume;
        solid.solid.lattice.points = move_points(solid).points;
        // The same solid over another lattice.
        const CutRequest request{solid.mesh, solid.solid.lattice, solid.faces};
        const Cut cut = cut_of(request);
        EXPECT_TRUE(are_consistent(request, cut));
        const CutCells raw = find_cells(request, cut);
        double sum = 0;
        for (const CutCell& cell : raw.cells) sum += cell.sums.volume;
        EXPECT_NEAR(sum / volume, 1, 1e-6);
    }
}

TEST(CutAgain, OfAFewTrianglesGivesWhatAWholeCutGives) {
    for (const Mesh& mesh : {crossing_balls(), test::torus_mesh(0.3, 0.1, 64, 32)}) {
        const CookedSolid solid = cooked(mesh);
        const Moved moved = move_points(solid);
        ASSERT_GT(moved.triangles.size(), 10u);
        ASSERT_LT(moved.triangles.size(), solid.mesh.triangles.size());
        CutRequest request{solid.mesh, solid.solid.lattice, solid.faces};
        request.points = moved.points;
        const Cut whole = cut_of(request);
        request.triangles = moved.triangles;
        request.wanted_faces = moved.faces;
        request.known = &solid.windings;
        request.is_known = moved.is_known;
        request.tetrahedron_of = solid.tetrahedron_of;
        const Cut some = cut_of(request);

        const auto keys = [](const Cut& cut, const auto& way) {
            std::vector<CutKey> list(cut.keys.begin() + way.first, cut.keys.begin() + way.first + way.count);
            std::rotate(list.begin(), std::min_element(list.begin(), list.end()), list.end());
            return list;
        };
        const auto polygons = [&](const Cut& cut) {
            std::vector<std::pair<std::array<uint32_t, 2>, std::vector<CutKey>>> list;
            for (const CutPolygon& p : cut.polygons)
                if (std::binary_search(moved.triangles.begin(), moved.triangles.end(), p.triangle))
                    list.push_back({{p.triangle, p.tetrahedron}, keys(cut, p)});
            std::sort(list.begin(), list.end());
            return list;
        };
        const auto loops = [&](const Cut& cut) {
            std::vector<std::pair<uint32_t, std::vector<CutKey>>> list;
            for (const CutLoop& loop : cut.loops)
                if (std::binary_search(moved.faces.begin(), moved.faces.end(), loop.face))
                    list.push_back({loop.face, keys(cut, loop)});
            std::sort(list.begin(), list.end());
            return list;
        };
        EXPECT_TRUE(polygons(some) == polygons(whole));
        EXPECT_TRUE(loops(some) == loops(whole));

        // Cells of the tetrahedra that have changed are those of the whole, to the bit.
        const CutCells cells = find_cells(request, some, moved.tetrahedra);
        request.triangles = {}, request.wanted_faces = {};
        const CutCells all = find_cells(request, whole);
        size_t at = 0, seen = 0;
        for (const CutCell& cell : cells.cells) {
            while (at < all.cells.size() && all.cells[at].tetrahedron < cell.tetrahedron) ++at;
            ASSERT_LT(at, all.cells.size());
            ASSERT_EQ(all.cells[at].tetrahedron, cell.tetrahedron);
            EXPECT_NEAR(all.cells[at].sums.volume, cell.sums.volume, 1e-12 * solid.solid.volume);
            ++at, ++seen;
        }
        EXPECT_GT(seen, 50u);
    }
}

TEST(CutAgain, APointThatNobodyKnowsIsRefused) {
    const CookedSolid solid = cooked(test::sphere_mesh(0.3, 2));
    const Moved moved = move_points(solid);
    CutRequest request{solid.mesh, solid.solid.lattice, solid.faces};
    request.triangles = moved.triangles;
    request.wanted_faces = moved.faces;
    request.known = &solid.windings;
    const std::vector<uint8_t> nobody(solid.solid.lattice.points.size());
    request.is_known = nobody;
    EXPECT_FALSE(cut_mesh(request).ok());
}

}  // namespace
}  // namespace cullet
