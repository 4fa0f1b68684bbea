// The step that no mode of a shell's springs outruns, whole or cut to pieces.
#include "systems/models/thick_shell/springs/fastest_mode.hpp"

#include <gtest/gtest.h>

#include "engine/random.hpp"
#include "sample_game/spring_bench.hpp"
#include "systems/models/thick_shell/springs/edge_stiffness.hpp"
#include "systems/models/thick_shell/springs/spring_lists.hpp"

namespace cullet {
namespace {

SpringSettings settings_of(SpringLayout layout) {
    SpringSettings settings;
    settings.layout = layout;
    settings.damping_ratio = 0;
    settings.is_slender = true;
    return settings;
}

/// Energy after steps of `share` of 2 / omega over that of the start: below some bound where no mode runs away.
double growth(SpringBench bench, double share) {
    set_spring_step(bench.view(), static_cast<float>(share * 2 / std::sqrt(fastest_mode(bench.view()))));
    const Random random{5};
    for (uint32_t v = 0; v < bench.size(); ++v) {
        // In the plane: across it one layer has no stiffness. So fast that floats are finer than the way of a step.
        const auto r = [&](uint32_t k) { return 0.05f * static_cast<float>(random.uniform(v, k) - 0.5); };
        bench.set_velocity(v, {r(0), r(1), 0});
    }
    measure_lengths(bench.view());
    const auto energy = [&] { return motion_of(bench.view()).kinetic + spring_energy(bench.view()); };
    const double start = energy();
    for (int i = 0; i < 2000; ++i) bench.step();
    return energy() / start;
}

TEST(FastestMode, NoModeIsFasterAndTheBoundIsClose) {
    for (const SpringLayout layout : {SpringLayout::OneLayer, SpringLayout::Sandwich, SpringLayout::Crossed}) {
        const auto disc = [&] { return SpringBench(bench_disc(4, 0.05), 0.01, {}, settings_of(layout)); };
        EXPECT_LT(growth(disc(), 0.93), 2) << static_cast<int>(layout);
        EXPECT_FALSE(growth(disc(), 1.5) < 100) << static_cast<int>(layout);
    }
}

TEST(FastestMode, OfALoneTriangleItIsTheBreathingOne) {
    // Three springs of E h A / L^2 = sqrt(3) / 4 E h between masses rho h A / 3 each: omega^2 = 3 k / m.
    SpringBench bench(bench_strip(1, 1, 0.1), 0.01, {}, settings_of(SpringLayout::OneLayer));
    const double k = std::sqrt(3.0) / 4 * 1e7 * 0.01, m = 1000 * 0.01 * std::sqrt(3.0) / 4 * 0.01 / 3;
    EXPECT_NEAR(fastest_mode(bench.view()) / (3 * k / m), 1, 0.02);
}

}  // namespace
}  // namespace cullet
