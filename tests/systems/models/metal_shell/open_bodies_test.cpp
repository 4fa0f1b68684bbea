// Bodies that are open: a tube on its end bears its load, and which way triangles are wound makes no difference.
#include <gtest/gtest.h>

#include "sample_game/metal/metal_bench.hpp"
#include "tests/systems/models/metal_shell/panels.hpp"

namespace cullet {
namespace {

constexpr double kLength = 1.5, kWidth = 0.24, kThickness = 1e-3;

/// Around z, open at both ends.
Mesh tube() {
    return test::grid_mesh(48, 61, true, false, [](uint32_t i, uint32_t j) {
        double sine, cosine;
        sine_cosine(2 * test::kPi * i / 48, sine, cosine);
        return Vec3d(0.5 * kWidth * cosine, 0.5 * kWidth * sine, kLength * j / 60);
    });
}

/// A bin: a cone with a bottom and without a lid.
Mesh bin() {
    Mesh mesh = test::grid_mesh(48, 25, true, false, [](uint32_t i, uint32_t j) {
        double sine, cosine;
        sine_cosine(2 * test::kPi * i / 48, sine, cosine);
        const double radius = 0.18 + 0.05 * j / 24;
        return Vec3d(radius * cosine, radius * sine, 0.6 * j / 24);
    });
    const auto middle = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.push_back({0, 0, 0});
    for (uint32_t i = 0; i < 48; ++i) mesh.triangles.push_back({middle, (i + 1) % 48, i});
    return mesh;
}

/// Every triangle of which n is a multiple of `each` is turned.
Mesh turned(Mesh mesh, size_t each) {
    for (size_t t = 0; t < mesh.triangles.size(); t += each) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    return mesh;
}

Model steel(const Mesh& mesh) {
    Result<Model> model = cook_metal_mesh(mesh, "steel", kThickness);
    if (!model) ADD_FAILURE() << model.error(), std::abort();
    return *model;
}

Striker floor_under(double x, Vec3d push) {
    Striker floor;
    floor.push = push, floor.point = x * push;
    return floor;
}

TEST(OpenBodies, ATubeOnItsEndFoldsAsFarAsItsLoadTakesTheEnergy) {
    const Model model = steel(tube());
    const double section = test::kPi * kWidth * kWidth / 4;
    double last = 0;
    for (const double energy : {1e-3, 0.5, 5.0, 44.0, 500.0, 3000.0}) {
        MetalBench bench(model);
        const double load = double{bench.view().shells().crush_pressure[bench.view().row]} * section;
        EXPECT_NEAR(load, 23e3, 2e3);
        const Dent dent = bench.hit(floor_under(0, {0, 0, 1}), energy);
        EXPECT_NEAR(dent.depth, energy / load, 0.02 * energy / load) << energy;
        EXPECT_GT(dent.depth, last);
        EXPECT_LE(dent.plastic, energy);
        EXPECT_EQ(dent.left, 0) << energy;
        last = dent.depth;
    }
}

// The floor comes from the side of the opening, of the bottom, of the wall, and from aslant.
TEST(OpenBodies, HoweverTheyAreWoundTheyDentAlike) {
    const Mesh meshes[] = {tube(), bin()};
    for (const Mesh& mesh : meshes) {
        const Model model = steel(mesh);
        for (const Mesh& other : {turned(mesh, 1), turned(mesh, 3), turned(mesh, 7)}) {
            const Model same = steel(other);
            for (const Vec3d push : {Vec3d(0, 0, 1), Vec3d(0, 0, -1), Vec3d(1, 0, 0), Vec3d(0.6, 0, 0.8)}) {
                MetalBench ours(model), theirs(same);
                double first = 1e30;
                for (uint32_t v = 0; v < ours.view().vertex_count(); ++v)
                    first = std::min(first, dot(Vec3d(ours.original(v)), push));
                const Dent a = ours.hit(floor_under(first, push), 120), b = theirs.hit(floor_under(first, push), 120);
                EXPECT_NEAR(a.depth, b.depth, 1e-6 * a.depth);
                EXPECT_GT(a.depth, 1e-3);
                EXPECT_LT(a.depth, 0.2);
                ASSERT_EQ(ours.view().vertex_count(), theirs.view().vertex_count());
                for (uint32_t v = 0; v < ours.view().vertex_count(); ++v)
                    EXPECT_LT(length(ours.place(v) - theirs.place(v)), 1e-5f);
            }
        }
    }
}

TEST(OpenBodies, NormalsThatCameWithTheWindingGoWithIt) {
    Mesh mesh = turned(bin(), 1);
    for (const auto& t : mesh.triangles) {
        const Vec3 p = mesh.positions[t[0]];
        const Vec3 normal = normalised(cross(mesh.positions[t[1]] - p, mesh.positions[t[2]] - p));
        for (int k = 0; k < 3; ++k) mesh.corner_normals.push_back(normal);
    }
    MetalBench bench(steel(mesh));
    const MetalView metal = bench.view();
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        const auto& c = metal.corners(e);
        const Vec3 across =
            cross(bench.original(c[1]) - bench.original(c[0]), bench.original(c[2]) - bench.original(c[0]));
        const auto& normal = metal.shell.state.elements.normal[metal.shell.element(e)];
        EXPECT_GT(dot(normalised(across), Vec3{normal[0], normal[1], normal[2]}), 0.9f) << e;
        const Vec3 middle = (1.0f / 3) * (bench.original(c[0]) + bench.original(c[1]) + bench.original(c[2]));
        EXPECT_GT(dot(across, middle - Vec3{0, 0, 0.3f}), 0) << e;
    }
}

}  // namespace
}  // namespace cullet
