// Solids from meshes: solid cooking note, sections 1, 3 and 4.
#include "systems/structures/tetrahedra/cook/cook_solid.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "engine/hash.hpp"
#include "engine/table.hpp"
#include "systems/structures/tetrahedra/cook/cover_lattice.hpp"
#include "tests/support/random_meshes.hpp"
#include "tests/support/simple_meshes.hpp"
#include "tests/support/solid_checks.hpp"

namespace cullet {
namespace {

CookedSolid cooked(const Mesh& mesh, SolidSettings settings = {}) {
    Result<CookedSolid> made = cook_solid(mesh, settings);
    if (!made) ADD_FAILURE() << made.error(), std::abort();
    return std::move(made).value();
}

void expect_sound(const Mesh& mesh, SolidSettings settings = {}) {
    for (const uint32_t element_edges : {2u, 4u}) {
        settings.element_edges = element_edges;
        const Result<CookedSolid> made = cook_solid(mesh, settings);
        ASSERT_TRUE(made) << made.error();
        const test::SolidReport report = test::check_solid(*made);
        EXPECT_TRUE(report.is_sound()) << mesh.name << ", elements of " << element_edges << " cells: " << report;
    }
}

Mesh named(Mesh mesh, const char* name) {
    mesh.name = name;
    return mesh;
}

/// A cup of 4 mm wall, 0.2 m wide.
Mesh bowl_mesh() {
    const std::vector<Vec2> profile{{0, 0},          {0.05f, 0},       {0.09f, 0.04f},   {0.1f, 0.09f},
                                    {0.096f, 0.09f}, {0.086f, 0.042f}, {0.048f, 0.004f}, {0, 0.004f}};
    return named(test::lathe_mesh(profile, 48), "bowl");
}

Mesh crossing_boxes() {
    Mesh mesh = named(test::box_mesh({1, 1, 1}, 2), "crossing boxes");
    test::append(mesh, test::box_mesh({0.5, 0.6, 1.7}, 1), {0.3, 0.2, -0.4});
    test::append(mesh, test::box_mesh({1.2, 0.1, 0.1}, 1), {0.7, 0.71, 0.33});
    return mesh;
}

Mesh hollow_ball() {
    Mesh mesh = named(test::sphere_mesh(1, 3), "hollow ball");
    test::append(mesh, test::turned_inside_out(test::sphere_mesh(0.6, 3)), {0.1, 0.05, 0});
    return mesh;
}

Mesh ball_with_bubble() {
    Mesh mesh = named(test::sphere_mesh(1, 3), "ball with a bubble");
    test::append(mesh, test::turned_inside_out(test::sphere_mesh(0.01, 1)), {0.1, 0.05, 0.02});
    return mesh;
}

TEST(CookSolid, SimpleShapesAreSound) {
    expect_sound(test::box_mesh({0.215, 0.065, 0.1025}, 1));
    expect_sound(test::sphere_mesh(0.1, 4));
    expect_sound(test::torus_mesh(0.3, 0.1, 96, 48));
    expect_sound(bowl_mesh());
    expect_sound(named(test::box_mesh({0.4, 0.01, 0.4}, 1), "plate"));
}

TEST(CookSolid, PartsThatCrossAndCavitiesAreSound) {
    expect_sound(crossing_boxes());
    expect_sound(hollow_ball());
    expect_sound(ball_with_bubble());
}

TEST(CookSolid, NeitherFewNorManyCellsMatter) {
    SolidSettings settings;
    for (const double cells : {1.0, 20.0, 200.0, 6000.0}) {
        settings.cells = cells;
        expect_sound(hollow_ball(), settings);
    }
    settings.cells = 1;
    const CookedSolid one = cooked(named(test::box_mesh({1, 1, 1}, 1), "one"), settings);
    EXPECT_LE(one.solid.cells.size(), 24u);  // corners of the box in other tetrahedra
}

TEST(CookSolid, ACellCountIsNearTheWantedOne) {
    SolidSettings settings;
    settings.element_edges = 2;
    for (const double cells : {500.0, 1500.0, 8000.0}) {
        settings.cells = cells;
        for (const Mesh& mesh : {test::sphere_mesh(1, 4), test::box_mesh({2, 1, 1}, 1)}) {
            const auto count = static_cast<double>(cooked(mesh, settings).solid.cells.size());
            EXPECT_GT(count, cells) << mesh.name;
            EXPECT_LT(count, 1.2 * cells) << mesh.name;
        }
    }
}

TEST(CookSolid, VolumesOfABoxAddUpToRounding) {
    const Mesh box = test::box_mesh({2, 1, 0.5}, 3);
    const CookedSolid made = cooked(box);
    EXPECT_DOUBLE_EQ(made.solid.volume, 1);
    EXPECT_DOUBLE_EQ(made.solid.area, 7);
    double volume = 0;
    Vec3d first;
    for (const SolidCell& cell : made.solid.cells) volume += cell.volume, first += cell.volume * cell.centroid;
    EXPECT_NEAR(volume, 1, 1e-7);
    EXPECT_NEAR(first.x, 1, 1e-7);
    EXPECT_NEAR(first.y, 0.5, 1e-7);
    EXPECT_NEAR(first.z, 0.25, 1e-7);
}

// Area of bonds is that of sections: a plane across the box cuts as much as its side has.
TEST(CookSolid, BondsCarryTheWholeSection) {
    const CookedSolid made = cooked(test::box_mesh({1, 1, 1}, 1));
    const Solid& solid = made.solid;
    // Cells to the left of a plane push those to the right: bonds between them, seen along x, sum up to the section.
    double section = 0;
    for (const SolidBond& bond : solid.bonds) {
        const bool is_left = solid.cells[bond.a].centroid.x < 0.5;
        if (is_left == (solid.cells[bond.b].centroid.x < 0.5)) continue;
        section += (is_left ? 1 : -1) * bond.area * bond.normal.x;
    }
    EXPECT_NEAR(section, 1, 1e-6);
}

TEST(CookSolid, ClosedMeshesKeepTheirTriangles) {
    const Mesh mesh = test::torus_mesh(0.3, 0.1, 24, 12);
    const CookedSolid made = cooked(mesh);
    ASSERT_EQ(made.mesh.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(made.notes, "");
    std::vector<uint8_t> is_seen(mesh.triangles.size());
    for (uint32_t t = 0; t < made.mesh.triangles.size(); ++t) {
        const uint32_t source = made.mesh.source[t];
        is_seen[source] = 1;
        for (uint32_t k = 0; k < 3; ++k) {
            const Vec3 drawn = mesh.positions[mesh.triangles[source][made.mesh.source_corners[t][k]]];
            EXPECT_TRUE(made.mesh.positions[made.mesh.triangles[t][k]] == Vec3d(drawn));
        }
    }
    for (const uint8_t seen : is_seen) EXPECT_TRUE(seen);
}

// A mesh of which every triangle lies in faces of the lattice and every point is one of its points.
TEST(CookSolid, WhatLiesInPlanesOfTheLatticeIsMovedOut) {
    SolidSettings settings;
    settings.element_edges = 2;
    const CookedSolid around = cooked(test::box_mesh({1, 1, 1}, 1), settings);
    const CoverLattice& lattice = around.solid.lattice;
    Mesh mesh;
    mesh.name = "elements";
    for (uint32_t c = 0; c < lattice.coarse.size(); c += 3) {
        bool is_deep = true;
        for (uint32_t k = 0; k < 4; ++k) is_deep = is_deep && !around.windings.of(lattice.coarse[c][k]).empty();
        if (!is_deep) continue;
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (uint32_t k = 0; k < 4; ++k) mesh.positions.push_back(lattice.points[lattice.coarse[c][k]].to_float());
        for (const auto& face : kFaceCorners)
            mesh.triangles.push_back({first + face[0], first + face[1], first + face[2]});
    }
    ASSERT_GT(mesh.triangles.size(), 8u);
    CoverLattice rounded = lattice;  // as the mesh's floats are
    for (Vec3d& p : rounded.points) p = Vec3d(p.to_float());
    const Result<ClosedMesh> closed = close_mesh(mesh);
    ASSERT_TRUE(closed) << closed.error();
    CookedSolid made;
    made.mesh = *closed;
    made.faces = around.faces;
    const CutRequest request{made.mesh, rounded, made.faces};
    const Result<Cut> cut = cut_mesh(request);
    ASSERT_TRUE(cut) << cut.error();
    const CutCells raw = find_cells(request, *cut);
    double volume = 0;
    for (const CutCell& cell : raw.cells) volume += cell.sums.volume;
    EXPECT_NEAR(volume / closed->volume, 1, 1e-5);
}

TEST(CookSolid, DegenerateAndRepeatedTrianglesAreHarmless) {
    Mesh mesh = named(test::box_mesh({1, 2, 1}, 3), "degenerate");
    const auto first = mesh.triangles[0], second = mesh.triangles[7];
    mesh.triangles.push_back(first);
    mesh.triangles.push_back({second[0], second[2], second[1]});
    mesh.triangles.push_back({first[0], first[1], first[0]});
    expect_sound(mesh);

    Mesh slivers = named(test::box_mesh({1, 1, 1}, 2), "slivers");
    for (Vec3& p : slivers.positions)
        if (p.x == 0.5f) p.x = 1e-7f;
    expect_sound(slivers);

    Mesh doubled = named(test::box_mesh({1, 1, 1}, 2), "doubled");
    test::append(doubled, test::box_mesh({1, 1, 1}, 1));
    expect_sound(doubled);

    Mesh touching = named(test::box_mesh({1, 1, 1}, 1), "two cubes that share an edge");
    test::append(touching, test::box_mesh({1, 1, 1}, 1), {1, 1, 0});
    expect_sound(touching);
}

TEST(CookSolid, AMeshScaledByAPowerOfTwoGivesTheSameCells) {
    const Mesh mesh = test::torus_mesh(0.3, 0.1, 48, 24);
    const CookedSolid small = cooked(mesh);
    for (const double factor : {2.0, 64.0, 0.125}) {
        const CookedSolid large = cooked(test::scaled(mesh, factor));
        ASSERT_EQ(large.solid.cells.size(), small.solid.cells.size());
        ASSERT_EQ(large.solid.bonds.size(), small.solid.bonds.size());
        for (size_t c = 0; c < small.solid.cells.size(); ++c) {
            EXPECT_EQ(large.solid.cells[c].volume, factor * factor * factor * small.solid.cells[c].volume);
            EXPECT_EQ(large.solid.cells[c].tetrahedron, small.solid.cells[c].tetrahedron);
        }
    }
}

TEST(CookSolid, OrderOfTrianglesAndPointsDoesNotMatter) {
    const Mesh mesh = bowl_mesh();
    const CookedSolid one = cooked(mesh), other = cooked(test::shuffled(mesh, 3));
    ASSERT_EQ(one.solid.cells.size(), other.solid.cells.size());
    for (size_t c = 0; c < one.solid.cells.size(); ++c)
        EXPECT_EQ(one.solid.cells[c].volume, other.solid.cells[c].volume);
}

uint64_t hash_of(const Solid& solid) {
    uint64_t hash = 0;
    const auto add = [&](const auto& value) { hash = hash_bytes(&value, sizeof value, hash); };
    for (const Vec3d& p : solid.lattice.points) add(p);
    for (const SolidCell& c : solid.cells) add(c.tetrahedron), add(c.volume), add(c.centroid);
    for (const CellMoments& m : solid.moments) add(m.cell), add(m.coarse), add(m.moments);
    for (const SolidBond& b : solid.bonds) add(b.a), add(b.b), add(b.area), add(b.centroid), add(b.normal);
    for (const SurfacePatch& p : solid.patches) add(p.triangle), add(p.cell), add(p.area), add(p.centroid);
    return hash;
}

// Whatever the compiler and its options: a change of these says so.
TEST(CookSolid, BytesAreTheSameEverywhere) {
    SolidSettings settings;
    EXPECT_EQ(hash_of(cooked(test::sphere_mesh(0.1, 4), settings).solid), 17838559764988020084u);
    settings.element_edges = 2;
    EXPECT_EQ(hash_of(cooked(crossing_boxes(), settings).solid), 11727258320939747475u);
}

// Noise makes folds and crossings. What is no solid says so.
TEST(CookSolid, RandomMeshesAreSoundOrRefused) {
    uint32_t sound = 0;
    for (uint64_t seed = 0; seed < 40; ++seed) {
        const Mesh mesh = test::random_mesh(seed);
        SolidSettings settings;
        settings.cells = 300;
        const Result<CookedSolid> made = cook_solid(mesh, settings);
        if (!made) {
            EXPECT_TRUE(made.error().find("is no solid") != std::string::npos ||
                        made.error().find("encloses no volume") != std::string::npos ||
                        made.error().find("Use thick_shell") != std::string::npos)
                << made.error();
            continue;
        }
        const test::SolidReport report = test::check_solid(*made);
        EXPECT_TRUE(report.is_sound()) << seed << ": " << report;
        ++sound;
    }
    EXPECT_GE(sound, 20u);
}

}  // namespace
}  // namespace cullet
