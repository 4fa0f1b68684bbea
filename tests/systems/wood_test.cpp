// Wood: strips cut along and across its grain against the table, bending, and which way it splits.
#include <gtest/gtest.h>

#include "tests/support/shell_meshes.hpp"
#include "systems/cook/materials.hpp"
#include "systems/damage/assemble.hpp"
#include "systems/damage/crack_candidates.hpp"
#include "systems/damage/element_bending.hpp"
#include "systems/damage/energy.hpp"
#include "systems/damage/stress_check.hpp"
#include "systems/motion/integrate_packs.hpp"
#include "systems/motion/start_hidden.hpp"

namespace cullet::test {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

const MaterialSettings& wood() {
    return compiled_materials()[9];
}

/// A square of wood in the plane z = 0, jittered triangles, grain at an angle to x.
struct Board {
    State state;
    Row<Shells> shell;
    double side = 1, thickness = 0.02;
    Board(double degrees, uint32_t n = 12) {
        fill_materials(state.materials);
        const Vec3 grain = Vec3d(std::cos(degrees * kDegree), std::sin(degrees * kDegree), 0).to_float();
        shell =
            make_test_shell(state, triangle_mesh(n, side, 0.2), thickness, material_row(state, wood(), grain), {}, 64);
    }
    ShellView view() { return {state, shell}; }
    /// Displacements u(x, y) into u and into the side of the probe that is read first.
    void deform(const std::function<Vec3d(double, double)>& u) {
        const ShellView s = view();
        for (uint32_t v = 0; v < s.vertex_count(); ++v) {
            const uint32_t row = s.vertex(v);
            const Vec3 p = state.vertices.rest[row], d = u(p.x, p.y).to_float();
            state.vertices.displacement.set(row, d);
            state.vertices.probe.data(0)[row] = {d.x, d.y, d.z, 0};
        }
    }
};

/// 1 / E of a strip at an angle to the grain: the turned compliance (Lekhnitskii).
double modulus_at(double degrees) {
    const MaterialSettings& m = wood();
    const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree);
    const double e1 = m.young_modulus, e2 = m.across_young_modulus, g = m.shear_modulus, nu = m.poisson_ratio;
    return 1 / (c * c * c * c / e1 + s * s * s * s / e2 + c * c * s * s * (1 / g - 2 * nu / e1));
}

/// Stretches a strip along x to a strain of 1 without load on its sides: eps = S sigma with sigma = (E, 0, 0).
std::array<double, 3> strip_strain(double degrees) {
    const PlaneStress stress{
        0,
        0,
        0,
        true,
        {wood().young_modulus, wood().across_young_modulus, wood().shear_modulus, wood().poisson_ratio,
         Vec3d(std::cos(degrees * kDegree), std::sin(degrees * kDegree), 0)}};
    const PlaneStiffness k = grain_stiffness(stress.grain, {1, 0, 0}, {0, 1, 0});
    // Free sides: c12 + c22 b + c26 g = 0, c16 + c26 b + c66 g = 0.
    const double d = k.c22 * k.c66 - k.c26 * k.c26;
    return {1, (-k.c12 * k.c66 + k.c16 * k.c26) / d, (-k.c16 * k.c22 + k.c12 * k.c26) / d};
}

TEST(Wood, StripsCutAtAnyAngleAreAsStiffAsTheTableSays) {
    for (const double degrees : {0.0, 15.0, 45.0, 70.0, 90.0}) {
        Board board(degrees);
        const auto eps = strip_strain(degrees);
        const double strain = 1e-4;
        board.deform([&](double x, double y) {
            return Vec3d(strain * (x + 0.5 * eps[2] * y), strain * (eps[1] * y + 0.5 * eps[2] * x), 0);
        });
        link_slopes(board.view());
        const double energy = membrane_energy(board.view(), 0, 0, board.view().element_count());
        const double volume = board.side * board.side * board.thickness;
        EXPECT_NEAR(2 * energy / (volume * strain * strain) / modulus_at(degrees), 1, 0.01) << degrees;
    }
    EXPECT_NEAR(modulus_at(0), 10e9, 1);
    EXPECT_NEAR(modulus_at(90), 0.5e9, 1);
}

TEST(Wood, StripsBreakAtTheTablesStrengthAlongAndAcrossAndByHankinsonBetween) {
    for (const double degrees : {0.0, 30.0, 60.0, 90.0}) {
        Board board(degrees);
        const auto eps = strip_strain(degrees);
        // A strain at which the stress is the short-load strength that the formula gives.
        const double c = std::cos(degrees * kDegree) * std::cos(degrees * kDegree);
        const double strength = 2 * 80e6 * 3e6 / (80e6 * (1 - c) + 3e6 * c);
        const double strain = strength / modulus_at(degrees);
        board.deform([&](double x, double y) {
            return Vec3d(strain * (x + 0.5 * eps[2] * y), strain * (eps[1] * y + 0.5 * eps[2] * x), 0);
        });
        check_stress(board.view(), 0);
        const CrackLimits limits = crack_limits(board.view(), 1);
        const ShellView s = board.view();
        for (uint32_t v = 0; v < s.vertex_count(); ++v) {
            const StartField field = start_field(s, v, limits.grain);
            // Between the axes a plane a little off the pull's, where the grain is weaker, may give way first.
            EXPECT_GT(field.stress / limits.start, 0.99) << degrees;
            EXPECT_LT(field.stress / limits.start, degrees == 0 || degrees == 90 ? 1.05 : 1.5) << degrees;
        }
    }
}

TEST(Wood, TensionAcrossTheGrainOpensACrackAlongIt) {
    Board board(25);
    const double strain = 0.02;
    board.deform([&](double x, double y) { return Vec3d(strain * x, strain * y, 0); });
    check_stress(board.view(), 0);
    const CrackLimits limits = crack_limits(board.view(), 1);
    const StartField field = start_field(board.view(), 40, limits.grain);
    EXPECT_GT(field.stress, limits.start);
    EXPECT_LT(std::abs(dot(field.across, limits.grain.grain)), 0.1f);
    EXPECT_EQ(field.ratio, 0);  // two arms: no stars
}

TEST(Wood, AStripBendsWithTheModulusOfItsOwnDirection) {
    // w = kappa x^2 / 2 with the curvature across that leaves the long edges free.
    for (const double degrees : {0.0, 90.0, 30.0}) {
        Board board(degrees, 24);
        const auto eps = strip_strain(degrees);
        const double kappa = 1e-3;
        board.deform(
            [&](double x, double y) { return Vec3d(0, 0, 0.5 * kappa * (x * x + eps[1] * y * y + eps[2] * x * y)); });
        check_stress(board.view(), 0);
        const double energy = bending_energy(board.view(), 0, board.view().element_count());
        const double h = board.thickness, wanted = 0.5 * modulus_at(degrees) * h * h * h / 12 * kappa * kappa;
        // Triangles at the border have hinges on two sides: their share, 1 in 12, is soft.
        EXPECT_NEAR(energy / wanted, 1, 0.1) << degrees;
    }
}

TEST(Wood, RowsAreTheGradientOfTheEnergyAndKeepMomentum) {
    Board board(35, 8);
    const ShellView s = board.view();
    const auto shake = [](uint32_t v) {
        return 1e-5 * Vec3d(std::sin(12.9 * v), std::sin(7.7 * v + 1), std::sin(3.1 * v + 2));
    };
    const auto place = [&](uint32_t changed, int axis, double by) {
        for (uint32_t v = 0; v < s.vertex_count(); ++v) {
            Vec3d d = shake(v);
            if (v == changed) d = d + by * Vec3d(axis == 0, axis == 1, axis == 2);
            board.state.vertices.probe.data(0)[s.vertex(v)] = {static_cast<float>(d.x), static_cast<float>(d.y),
                                                               static_cast<float>(d.z), 0};
        }
    };
    const auto energy = [&] {
        check_stress(s, 0);
        return membrane_energy(s, 0, 0, s.element_count()) + bending_energy(s, 0, s.element_count());
    };
    place(kNone, 0, 0);
    const HiddenStep step(s, 1, 0, 0);
    integrate_packs(step, 0, step.pack_count);
    Vec3d sum;
    double largest = 0;
    std::vector<Vec3d> force;
    for (uint32_t v = 0; v < s.vertex_count(); ++v) {
        const uint32_t row = s.vertex(v);
        force.push_back(board.state.vertices.element[row] == kNone
                            ? Vec3d()
                            : board.state.vertices.mass[row] * Vec3d(board.state.vertices.velocity[row]));
        sum += force.back();
        largest = std::max(largest, length(force.back()));
    }
    EXPECT_LT(length(sum), 1e-4 * largest);
    for (const uint32_t v : {9u, 20u, 33u})
        for (int axis = 0; axis < 3; ++axis) {
            const double by = 2e-6;
            place(v, axis, by);
            const double up = energy();
            place(v, axis, -by);
            const double down = energy();
            EXPECT_NEAR(force[v][axis], -(up - down) / (2 * by), 2e-3 * largest) << v << " " << axis;
        }
}

}  // namespace
}  // namespace cullet::test
