// From a rigid motion to points and back.
#include "systems/models/thick_shell/springs/start_springs.hpp"

#include <gtest/gtest.h>

#include "tests/support/spring_strip.hpp"

namespace cullet::test {
namespace {

TEST(StartSprings, GivesBackTheMotionOfPointsOnALineAndOfASinglePoint) {
    const Vec3d along = normalised(Vec3d(1, 2, -3));
    RigidMotion motion;
    motion.velocity = {1, 2, -3};
    motion.spin = {4, -5, 6};
    motion.pose.orientation = normalised(Quat{0.3f, -0.5f, 0.2f, 0.7f});
    for (const uint32_t count : {1u, 2u, 12u}) {
        std::vector<Vec3d> points;
        std::vector<GivenSpring> springs;
        for (uint32_t v = 0; v < count; ++v) {
            points.push_back((0.1 * v) * along);
            if (v > 0) springs.push_back({v - 1, v, 0.1f, 100});
        }
        SpringBench bench(points, std::vector<double>(count, 0.3), springs, {});
        start_springs(bench.view(), motion);
        const SpringMotion before = motion_of(bench.view());
        const RigidMotion back = stop_springs(bench.view());
        EXPECT_LT(length(back.velocity - motion.velocity), 1e-5f);
        // Of the spin what is across the line: no point knows of the rest.
        const Vec3d line(rotate(motion.pose.orientation, along.to_float())), spin(motion.spin);
        const Vec3d wanted = count > 1 ? spin - dot(spin, line) * line : Vec3d{};
        EXPECT_LT(length(Vec3d(back.spin) - wanted), 1e-5 * length(spin)) << count;
        for (uint32_t v = 0; v < count; ++v) {
            EXPECT_LT(length(bench.state().vertices.displacement[bench.view().shell.vertex(v)]), 1e-6f);
        }
        const double n = count, inertia = 0.3 * 0.01 * n * (n * n - 1) / 12;
        EXPECT_NEAR(before.kinetic, 0.5 * (0.3 * n * 14 + inertia * dot(wanted, wanted)), 1e-4 * before.kinetic);
    }
}

TEST(StartSprings, GivesBackTheMotionThatItTook) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench bench = make_strip(layout);
        RigidMotion motion;
        motion.pose.position = {1000, -20, 3};
        motion.pose.orientation = normalised(Quat{0.3f, -0.5f, 0.2f, 0.7f});
        motion.velocity = {1, 2, -3};
        motion.spin = {4, -5, 6};
        start_springs(bench.view(), motion);
        const RigidMotion back = stop_springs(bench.view());
        EXPECT_LT(length(back.pose.position - motion.pose.position), 1e-4f);
        const Quat turn = back.pose.orientation * conjugate(motion.pose.orientation);
        EXPECT_NEAR(std::fabs(turn.w), 1, 1e-6);
        EXPECT_LT(length(back.velocity - motion.velocity), 1e-5f);
        EXPECT_LT(length(back.spin - motion.spin), 2e-4f);
        for (uint32_t v = 0; v < bench.size(); ++v)
            EXPECT_LT(length(bench.state().vertices.displacement[bench.view().shell.vertex(v)]), 1e-7f);
    }
}

}  // namespace
}  // namespace cullet::test
