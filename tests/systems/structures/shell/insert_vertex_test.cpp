// Splitting an edge by a vertex (thick shell note C5).
#include "components/state.hpp"
#include "systems/structures/shell/insert_vertex.hpp"

#include <gtest/gtest.h>

#include "engine/random.hpp"
#include "systems/models/thick_shell/hidden/crack_candidates.hpp"
#include "systems/models/thick_shell/hidden/crack_rules.hpp"
#include "systems/models/thick_shell/stiffness/refresh.hpp"
#include "tests/support/crack_meshes.hpp"

namespace cullet {
namespace {

using namespace crack_test;

Vec3d centre_of(ShellView shell) {
    Vec3d sum;
    double mass = 0;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        sum += shell.state.vertices.mass[row] * Vec3d(shell.state.vertices.rest[row]);
        mass += shell.state.vertices.mass[row];
    }
    return (1 / mass) * sum;
}

TEST(InsertVertex, TwoTrianglesBecomeFourAndTheVertexLiesOnTheEdge) {
    Shell shell = make_shell_of(sphere(2, 0.1), 4, 4);
    const ShellView view = shell.view;
    const uint32_t elements = view.element_count(), hinges = view.hinge_count();
    const auto corner = shell.state->elements.corner[view.element(5)];
    Touched touched{kStiffnessRepair};
    bool is_full;
    ASSERT_TRUE(can_insert(view, 5, 1, 0.375f, is_full));
    const uint32_t w = insert_vertex(view, 5, 1, 0.375f, touched);
    EXPECT_EQ(view.element_count(), elements + 2);
    EXPECT_EQ(view.hinge_count(), hinges + 3);
    const Vertices& v = shell.state->vertices;
    const Vec3 p = v.rest[view.vertex(corner[1])], q = v.rest[view.vertex(corner[2])];
    EXPECT_LT(length(v.rest[view.vertex(w)] - (p + 0.375f * (q - p))), 1e-8f);
    EXPECT_NEAR(length(v.inward[view.vertex(w)]), 1, 1e-6);
    EXPECT_EQ(broken_rule(shell), "");
}

// Coarse fracture: a ban ends, and where an edge is split it ends when those of both ends have.
TEST(InsertVertex, TheNewVertexIsBannedAsLongAsTheEndsOfItsEdge) {
    struct Case {
        float first, second;  // s; below 0: no ban
        bool is_second_a_tip;
        float wanted;
    };
    const Case cases[] = {{3e-5f, 2e-5f, false, 3e-5f},
                          {-1, 2e-5f, false, 2e-5f},
                          {1e-5f, 2e-5f, true, 1e-5f},
                          {-1, 2e-5f, true, 0},
                          {-1, -1, false, 0}};
    for (const Case& c : cases) {
        Shell shell = make_shell_of(sphere(2, 0.1), 4, 4);
        const ShellView view = shell.view;
        Vertices& v = shell.state->vertices;
        const auto corner = shell.state->elements.corner[view.element(5)];
        const uint32_t p = view.vertex(corner[1]), q = view.vertex(corner[2]);
        const auto ban = [&](uint32_t row, float until) {
            v.is_start_banned[row] = until >= 0;
            v.ready_time[row] = std::max(until, 0.0f);
        };
        ban(p, c.first), ban(q, c.second);
        if (c.is_second_a_tip) v.crack[q] = static_cast<uint8_t>(CrackState::Tip);
        Touched touched{kStiffnessRepair};
        bool is_full;
        ASSERT_TRUE(can_insert(view, 5, 1, 0.5f, is_full));
        const uint32_t w = view.vertex(insert_vertex(view, 5, 1, 0.5f, touched));
        EXPECT_EQ(v.is_start_banned[w], c.first >= 0 || c.second >= 0);
        EXPECT_EQ(v.ready_time[w], c.wanted);
        EXPECT_EQ(v.crack[w], static_cast<uint8_t>(CrackState::None));
        EXPECT_FALSE(c.wanted > 0 && may_start(v, w, FractureKind::Coarse, 0.5f * c.wanted));
        EXPECT_FALSE(v.is_start_banned[w] && may_start(v, w, FractureKind::Large, 1)) << "its bans last";
    }
}

TEST(InsertVertex, AtTheBorderOneTriangleBecomesTwo) {
    Shell shell = make_shell_of(sheet(4, 4, 1, 1), 4, 4);
    const ShellView view = shell.view;
    for (uint32_t e = 0; e < view.element_count(); ++e)
        for (uint32_t k = 0; k < 3; ++k) {
            if (shell.state->elements.neighbour[view.element(e)][k] != kNone) continue;
            const uint32_t elements = view.element_count();
            Touched touched{kStiffnessRepair};
            bool is_full;
            ASSERT_TRUE(can_insert(view, e, k, 0.5f, is_full));
            insert_vertex(view, e, k, 0.5f, touched);
            EXPECT_EQ(view.element_count(), elements + 1);
            EXPECT_EQ(broken_rule(shell), "");
            return;
        }
    FAIL() << "no border edge";
}

TEST(InsertVertex, MassCentreAndMomentumStayAndEnergyNeverRises) {
    Shell shell = make_shell_of(sphere(3, 0.1), 200, 400);
    const ShellView view = shell.view;
    shake(view, 11);
    const Random random{5};
    const Motion3 start = motion_of(view);
    const Vec3d centre = centre_of(view);
    double energy = start.energy;
    uint32_t inserted = 0;
    for (uint32_t i = 0; inserted < 100; ++i) {
        const uint32_t e = static_cast<uint32_t>(random.bits(i, 0) % view.element_count());
        const float tau = static_cast<float>(0.25 + 0.5 * random.uniform(i, 1));
        const uint32_t k = static_cast<uint32_t>(random.bits(i, 2) % 3);
        Touched touched{kStiffnessRepair};
        bool is_full;
        if (!can_insert(view, e, k, tau, is_full)) continue;
        insert_vertex(view, e, k, tau, touched);
        ++inserted;
        const Motion3 now = motion_of(view);
        ASSERT_LT(length(now.momentum - start.momentum), 1e-8 * inserted * length(start.momentum) + 1e-12);
        ASSERT_LE(now.energy, energy * (1 + 1e-8));
        energy = now.energy;
    }
    EXPECT_LT(length(centre_of(view) - centre), 1e-9);
    EXPECT_EQ(broken_rule(shell), "");
}

TEST(InsertVertex, ARotatingSphereLosesBelowTwoInTenThousandOfItsAngularMomentumInAHundredInserts) {
    Shell shell = make_shell_of(sphere(4, 0.1), 200, 400);
    const ShellView view = shell.view;
    for (uint32_t v = 0; v < view.vertex_count(); ++v)
        shell.state->vertices.velocity.set(view.vertex(v),
                                           cross({0, 0, 20}, shell.state->vertices.rest[view.vertex(v)]));
    const Motion3 start = motion_of(view);
    const Random random{6};
    for (uint32_t i = 0, inserted = 0; inserted < 100; ++i) {
        const uint32_t e = static_cast<uint32_t>(random.bits(i, 0) % view.element_count());
        Touched touched{kStiffnessRepair};
        bool is_full;
        if (!can_insert(view, e, i % 3, 0.5f, is_full)) continue;
        insert_vertex(view, e, i % 3, 0.5f, touched);
        ++inserted;
    }
    const double drift = length(motion_of(view).angular - start.angular) / length(start.angular);
    RecordProperty("drift", std::to_string(drift));
    EXPECT_LT(drift, 2e-4);
}

TEST(InsertVertex, NoTriangleFallsBelowTheLeastShape) {
    Shell shell = make_shell_of(sheet(16, 16, 1, 1, 0.4), 2000, 4000);
    const ShellView view = shell.view;
    const Random random{9};
    const float l = view.shells().mean_edge[view.row];
    for (uint32_t i = 0; i < 3000; ++i) {
        const uint32_t e = static_cast<uint32_t>(random.bits(i, 0) % view.element_count());
        const float tau = static_cast<float>(0.25 + 0.5 * random.uniform(i, 1));
        Touched touched{kStiffnessRepair};
        bool is_full;
        if (can_insert(view, e, i % 3, tau, is_full)) insert_vertex(view, e, i % 3, tau, touched);
    }
    EXPECT_GT(view.element_count(), 1000u);
    for (uint32_t e = 0; e < view.element_count(); ++e) {
        Vec3 c[3];
        for (int k = 0; k < 3; ++k)
            c[k] = shell.state->vertices.rest[view.vertex(shell.state->elements.corner[view.element(e)][k])];
        const float twice_area = length(cross(c[1] - c[0], c[2] - c[0]));
        const float longest = std::max({length(c[1] - c[0]), length(c[2] - c[1]), length(c[0] - c[2])});
        ASSERT_GT(twice_area, 0.99f * kLeastShape * longest * longest);
        ASSERT_GT(twice_area / 2, 0.99f * kLeastArea * kEquilateralArea * l * l);
    }
    EXPECT_EQ(broken_rule(shell), "");
}

TEST(InsertVertex, TextureCoordinatesAndStressFollowThePlane) {
    Shell shell = make_shell_of(sheet(6, 6, 1, 1, 0.3), 50, 100);
    const ShellView view = shell.view;
    const Sym3d wanted{3e6, -1e6, 0, 2e6, 0, 0};
    set_stress(view, [&](Vec3, int) { return wanted; });
    for (uint32_t e = 0; e < 30; ++e) {
        Touched touched{kStiffnessRepair};
        bool is_full;
        if (can_insert(view, e, e % 3, 0.4f, is_full)) insert_vertex(view, e, e % 3, 0.4f, touched);
    }
    ASSERT_GT(view.element_count(), 72u);
    const State& s = *shell.state;
    for (uint32_t e = 0; e < view.element_count(); ++e) {
        const uint32_t row = view.element(e);
        for (uint32_t k = 0; k < 3; ++k) {
            const Vec3 p = s.vertices.rest[view.vertex(s.elements.corner[row][k])];
            EXPECT_NEAR(s.elements.uv[row][2 * k], p.x, 1e-6);
            EXPECT_NEAR(s.elements.uv[row][2 * k + 1], p.y, 1e-6);
        }
        const Vec3d x(s.triangle_springs.axis_x[row]), y(s.triangle_springs.axis_y[row]);
        EXPECT_NEAR(s.elements.outer_stress[row].x, dot(x, wanted * x), 10);
        EXPECT_NEAR(s.elements.inner_stress[row].y, dot(y, wanted * y), 10);
        EXPECT_NEAR(s.elements.inner_stress[row].z, dot(x, wanted * y), 10);
    }
}

TEST(InsertVertex, WithoutRoomItIsRefused) {
    Shell shell = make_shell_of(sheet(4, 4, 1, 1), 1, 1);
    bool is_full;
    EXPECT_FALSE(can_insert(shell.view, 9, 0, 0.5f, is_full));
    EXPECT_TRUE(is_full);
}

}  // namespace
}  // namespace cullet
