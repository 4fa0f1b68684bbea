// Bodies that are open: a tube on its end bears its load.
#include <gtest/gtest.h>

#include <cmath>

#include "sample_game/metal/metal_bench.hpp"
#include "tests/systems/models/metal_shell/panels.hpp"

namespace cullet {
namespace {

constexpr double kLength = 1.5, kWidth = 0.24, kThickness = 1e-3;

/// Around z, open at both ends.
Mesh tube() {
    return test::grid_mesh(48, 61, true, false, [](uint32_t i, uint32_t j) {
        const double angle = 2 * test::kPi * i / 48;
        return Vec3d(0.5 * kWidth * std::cos(angle), 0.5 * kWidth * std::sin(angle), kLength * j / 60);
    });
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

}  // namespace
}  // namespace cullet
