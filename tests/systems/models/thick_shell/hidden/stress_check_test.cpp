// Stress of faces and at vertices against fields whose stress is known.
#include "components/state.hpp"
#include "systems/models/thick_shell/stiffness/element_stress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "engine/random.hpp"
#include "engine/simd.hpp"
#include "systems/models/thick_shell/hidden/energy.hpp"
#include "systems/models/thick_shell/hidden/vertex_stress.hpp"
#include "tests/support/shell_meshes.hpp"

namespace cullet::test {
namespace {

constexpr double kYoung = 70e9, kPoisson = 0.22, kThickness = 0.005;

struct Fixture {
    State state;
    Row<Structures> shell;
    explicit Fixture(const ShellMesh& mesh) {
        shell = make_test_shell(state, mesh, kThickness, add_material(state, kYoung, kPoisson, 2400));
    }
    ShellView view() { return {state, shell}; }
    template <class Field>
    void displace(Field u) {
        for (uint32_t v = 0; v < view().vertex_count(); ++v) {
            const uint32_t row = view().vertex(v);
            const Vec3d d = u(Vec3d(state.vertices.rest[row]));
            state.vertices.displacement.set(row, d.to_float());
            for (int side = 0; side < 2; ++side)
                state.vertices.probe.set(
                    row, {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z), 0}, side);
        }
        check_stress(view(), 0);
    }
    bool is_on_border(uint32_t element) {
        const auto& n = state.elements.neighbour[view().element(element)];
        return std::find(n.begin(), n.end(), kNone) != n.end();
    }
    /// Tensor of an element's face in world axes x, y of the plane z = 0.
    Vec3d stress(uint32_t element, int face) {
        const uint32_t e = view().element(element);
        const Vec3d s(face == 0 ? state.elements.outer_stress[e] : state.elements.inner_stress[e]);
        const Vec3d x(state.triangle_springs.axis_x[e]), y(state.triangle_springs.axis_y[e]);
        const auto part = [&](double xx, double yy, double xy) { return s.x * xx + s.y * yy + s.z * xy; };
        return {part(x.x * x.x, y.x * y.x, 2 * x.x * y.x), part(x.y * x.y, y.y * y.y, 2 * x.y * y.y),
                part(x.x * x.y, y.x * y.y, x.x * y.y + x.y * y.x)};
    }
};

const double kC = kYoung / (1 - kPoisson * kPoisson);
Vec3d plane_stress_of(double xx, double yy, double gamma) {
    return {kC * (xx + kPoisson * yy), kC * (kPoisson * xx + yy), kC * 0.5 * (1 - kPoisson) * gamma};
}

TEST(StressCheck, UniformStrainGivesUniformStressOnAnyMesh) {
    Fixture f(grid_mesh(12, 0.5, 0.3));
    for (uint32_t e = 0; e < f.view().element_count(); ++e) f.state.triangle_springs.scale[f.view().element(e)] = 1;
    const double xx = 3e-4, yy = -1e-4, gamma = 2e-4;
    f.displace([&](Vec3d p) {
        return Vec3d{xx * p.x + 0.7 * gamma * p.y + 1e-3, yy * p.y + 0.3 * gamma * p.x - 2e-3, 5e-4};
    });
    const Vec3d expected = plane_stress_of(xx, yy, gamma);
    for (uint32_t e = 0; e < f.view().element_count(); ++e)
        for (int face = 0; face < 2; ++face)
            ASSERT_LT(length(f.stress(e, face) - expected), 3e-4 * length(expected)) << "element " << e;
    // And at vertices, with the directions of its principal stresses.
    for (uint32_t v = 0; v < f.view().vertex_count(); ++v) {
        const VertexStress s = vertex_stress(f.view(), v)[v % 2];
        float s1 = 0, s2 = 0;
        Vec3 d;
        principal(s, s1, s2, d);
        const double mean = 0.5 * (expected.x + expected.y), half = 0.5 * (expected.x - expected.y);
        const double radius = std::sqrt(half * half + expected.z * expected.z);
        ASSERT_NEAR(s1, mean + radius, 1e-4 * radius);
        ASSERT_NEAR(s2, mean - radius, 1e-4 * radius);
        // sigma d = s1 d
        const Vec3d residual{expected.x * d.x + expected.z * d.y - s1 * d.x,
                             expected.z * d.x + expected.y * d.y - s1 * d.y, 0};
        ASSERT_LT(length(residual), 1e-3 * radius);
        ASSERT_NEAR(length(d), 1, 1e-5);
    }
}

TEST(StressCheck, UniformCurvatureGivesUniformBendingStressOnEquilateralTriangles) {
    // The whole sheet bends to w = 1/2 (a x^2 + b y^2) + c x y: outer face (above) is in compression where a > 0.
    ShellMesh mesh = triangle_mesh(20, 0.5, 0);
    const double a = 0.02, b = -0.01, c = 0.007;
    for (const bool spherical : {true, false}) {
        Fixture f(mesh);
        const double kb = spherical ? a : b, kc = spherical ? 0 : c;
        f.displace([&](Vec3d p) { return Vec3d{0, 0, 0.5 * (a * p.x * p.x + kb * p.y * p.y) + kc * p.x * p.y}; });
        const double h = kThickness / 2;
        const Vec3d expected = plane_stress_of(-h * a, -h * kb, -2 * h * kc);
        Vec3d mean;
        uint32_t inner = 0;
        for (uint32_t e = 0; e < f.view().element_count(); ++e) {
            if (f.is_on_border(e)) continue;
            mean += f.stress(e, 0), ++inner;
            EXPECT_LT(length(f.stress(e, 0) + f.stress(e, 1)), 1e-3 * length(expected));
        }
        mean = (1.0 / inner) * mean;
        // The rows are 1 % off equilateral.
        EXPECT_LT(length(mean - expected), 0.03 * length(expected)) << (spherical ? "spherical" : "saddle");
    }
}

TEST(StressCheck, AllSimdLevelsGiveTheSameBits) {
    const Random random{5};
    uint64_t expected = 0;
    for (const SimdLevel level :
         {SimdLevel::Scalar, SimdLevel::Sse4, SimdLevel::Avx2, SimdLevel::Avx512, SimdLevel::Best}) {
        if (!set_simd_level(level)) continue;
        Fixture f(sphere_mesh(7, 0.1));
        uint64_t k = 0;
        f.displace([&](Vec3d) {
            const double x = random.uniform(k++), y = random.uniform(k++), z = random.uniform(k++);
            return Vec3d{1e-5 * x, 1e-5 * y, 1e-5 * z};
        });
        uint64_t hash = 0;
        const ShellView s = f.view();
        const auto add = [&](const float* data, uint32_t count) { hash = hash_bytes(data, 4 * count, hash); };
        for (int l = 0; l < 3; ++l) {
            add(f.state.elements.outer_stress.lane(l) + s.element(0), s.element_count());
            add(f.state.elements.inner_stress.lane(l) + s.element(0), s.element_count());
        }
        add(f.state.elements.principal.data() + s.element(0), s.element_count());
        add(f.state.elements.slope[s.element(0)].data(), 3 * s.element_count());
        const double energy = membrane_energy(s, 0, 0, s.element_count());
        hash = hash_bytes(&energy, 8, hash);
        if (expected == 0) expected = hash;
        EXPECT_EQ(hash, expected) << "level " << static_cast<int>(level);
    }
    set_simd_level(SimdLevel::Best);
}

TEST(StressCheck, ChunksGiveTheSameBitsAsOneCall) {
    Fixture f(sphere_mesh(7, 0.1)), g(sphere_mesh(7, 0.1));
    const auto field = [](Vec3d p) { return Vec3d{1e-4 * p.y * p.y, 3e-4 * p.z * p.x, -2e-4 * p.x}; };
    f.displace(field), g.displace(field);
    const ShellView s = g.view();
    for (uint32_t e = 0; e < s.element_count(); e += 40) strain_elements(s, 0, e, std::min(40u, s.element_count() - e));
    for (uint32_t e = 0; e < s.element_count(); e += 88)
        stress_elements(s, e, std::min(88u, s.element_count() - e), kNeverStarts);
    for (uint32_t e = 0; e < s.element_count(); ++e) {
        ASSERT_EQ(f.state.elements.principal[s.element(e)], g.state.elements.principal[s.element(e)]);
        ASSERT_EQ(f.state.elements.inner_stress[s.element(e)], g.state.elements.inner_stress[s.element(e)]);
    }
}

TEST(StressCheck, AHingesAngleIsItsGradientTimesTheDisplacements) {
    Fixture f(sphere_mesh(5, 0.1));
    f.displace([](Vec3d p) { return Vec3d{1e-2 * p.y * p.y, 3e-2 * p.z * p.x, -2e-2 * p.x * p.y}; });
    double largest = 0, error = 0;
    const ShellView view = f.view();
    const float* slope = f.state.elements.slope[view.element(0)].data();
    for (uint32_t half = 0; half < 3 * view.element_count(); ++half) {
        const uint32_t element = view.element(half / 3), other = f.state.elements.other_slope[element][half % 3];
        if (other == half) continue;
        const uint32_t row = view.hinge(f.state.elements.hinge[element][half % 3]);
        const auto& g = f.state.hinges.gradient[row];
        double theta = 0;
        for (uint32_t k = 0; k < 4; ++k)
            theta += dot(Vec3d(g[3 * k], g[3 * k + 1], g[3 * k + 2]),
                         Vec3d(f.state.vertices.displacement[view.vertex(f.state.hinges.vertex[row][k])]));
        largest = std::max(largest, std::fabs(theta));
        error = std::max(error, std::fabs(theta - (double{slope[half]} + slope[other])));
    }
    EXPECT_GT(largest, 1e-5);
    EXPECT_LT(error, 1e-5 * largest);
}

TEST(StressCheck, MembraneEnergyIsHalfStressTimesStrainTimesVolume) {
    Fixture f(grid_mesh(10, 0.5, 0.2));
    for (uint32_t e = 0; e < f.view().element_count(); ++e) f.state.triangle_springs.scale[f.view().element(e)] = 1;
    const double xx = 3e-4, yy = -1e-4, gamma = 2e-4;
    f.displace([&](Vec3d p) { return Vec3d{xx * p.x + gamma * p.y, yy * p.y, 0}; });
    const Vec3d s = plane_stress_of(xx, yy, gamma);
    const double expected = 0.5 * (s.x * xx + s.y * yy + s.z * gamma) * 0.25 * kThickness;
    EXPECT_NEAR(membrane_energy(f.view(), 0, 0, f.view().element_count()), expected, 1e-5 * expected);
}

}  // namespace
}  // namespace cullet::test
