// A charge that lies against a wall: the wall shades what stands behind it.
#include <gtest/gtest.h>

#include "components/state.hpp"
#include "systems/structures/shell/explosion.hpp"
#include "tests/support/sample_shells.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet::test {
namespace {

constexpr double kSide = 0.4;
constexpr uint32_t kCuts = 12;
constexpr float kEdge = static_cast<float>(kSide / kCuts);
constexpr float kReach = 2, kStrength = 100;

/// A closed box from the origin to (kSide, kSide, kSide), 4 mm thick.
ShellView box_shell(State& state) {
    const Mesh mesh = box_mesh({kSide, kSide, kSide}, kCuts);
    SampleSurface surface;
    const Vec3d middle{kSide / 2, kSide / 2, kSide / 2};
    for (const Vec3 p : mesh.positions) {
        surface.position.push_back(Vec3d(p));
        surface.inward.push_back(normalised(middle - Vec3d(p)));
        surface.depth.push_back(0.004);
    }
    surface.corner = mesh.triangles;
    surface.wanted_depth = 0.004;
    link_elements(surface);
    const auto built = build_shell(state, surface.source(), sample_material(state));
    EXPECT_TRUE(built.ok()) << built.error();
    return {state, built.value()};
}

/// The formula's impulse on the elements whose middles `is_meant` names, all of them lit.
template <class IsMeant>
Vec3d lit_impulse(const ShellView& shell, Vec3 centre, IsMeant is_meant) {
    const ShellRows& state = shell.state;
    Vec3d sum;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        Vec3d p[3];
        for (int k = 0; k < 3; ++k)
            p[k] = Vec3d(state.vertices.rest[shell.vertex(state.elements.corner[shell.element(e)][k])]);
        const Vec3d middle = (1.0 / 3) * (p[0] + p[1] + p[2]), away = middle - Vec3d(centre);
        if (!is_meant(middle)) continue;
        const Vec3d area = 0.5 * cross(p[1] - p[0], p[2] - p[0]);
        const double distance = length(away), left = 1 - distance / kReach;
        sum += (kStrength * left * left * dot(area, away) / (length(area) * distance)) * area;
    }
    return sum;
}

const float kGaps[] = {0.05f, 0.3f, 0.9f, 2.0f};  // mean edges
const Vec2 kPlaces[] = {{0.2f, 0.2f}, {0.2f + 0.3f * kEdge, 0.17f + 0.4f * kEdge}, {0.12f, 0.27f}};

TEST(ExplosionShade, OfAChargeAgainstTheOutsideTheFarWallGetsNothing) {
    State state;
    const ShellView shell = box_shell(state);
    const auto is_top = [](Vec3d middle) { return middle.z > kSide - 1e-6; };
    for (const float gap : kGaps)
        for (const Vec2 at : kPlaces) {
            const Vec3 centre{at.x, at.y, static_cast<float>(kSide) + gap * kEdge};
            const double wanted = lit_impulse(shell, centre, is_top).z;
            const double found = measure_explosion(shell, {centre, kReach, kStrength}, {}).impulse.z;
            EXPECT_LT(wanted, 0);
            EXPECT_NEAR(found, wanted, -0.02 * wanted) << gap << " edges at " << at.x << ", " << at.y;
        }
}

TEST(ExplosionShade, OfAChargeAgainstTheInsideAllWallsAreLit) {
    State state;
    const ShellView shell = box_shell(state);
    for (const float gap : kGaps)
        for (const Vec2 at : kPlaces) {
            const Vec3 centre{at.x, at.y, static_cast<float>(kSide) - gap * kEdge};
            const Vec3d wanted = lit_impulse(shell, centre, [](Vec3d) { return true; });
            const Vec3d found = measure_explosion(shell, {centre, kReach, kStrength}, {}).impulse;
            EXPECT_LT(length(found - wanted), 0.02 * length(wanted)) << gap << " edges at " << at.x << ", " << at.y;
        }
}

}  // namespace
}  // namespace cullet::test
