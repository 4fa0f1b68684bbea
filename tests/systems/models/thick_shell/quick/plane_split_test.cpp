// A vertex split along a plane: the invariants of C3, whatever the plane, and the re-meshing before it.
#include <gtest/gtest.h>

#include "engine/random.hpp"
#include "systems/models/thick_shell/stiffness/refresh.hpp"
#include "tests/support/plane_splits.hpp"

namespace cullet::crack_test {
namespace {

struct Body {
    const char* name;
    TestSurface surface;
};
std::vector<Body> bodies() {
    return {{"sphere", sphere(3, 0.1)},
            {"sheet", sheet(12, 10, 0.12, 0.10, 0.25)},
            {"spindle", closed_lathe(16, 10, 0.05, 0.2)}};
}

TEST(PlaneSplit, AnyHistoryOfSplitsKeepsTheMeshSoundAndMovesNothing) {
    for (const Body& body : bodies()) {
        Shell shell = make_shell_of(body.surface, 4000, 8000);
        shake(shell.view, 7);
        const Random random{11};
        Touched touched(kStiffnessRepair);
        uint32_t cuts = 0, inserted = 0;
        for (uint32_t n = 0; n < 150; ++n) {
            const auto vertex = static_cast<uint32_t>(random.bits(n, 1) % shell.view.vertex_count());
            if (shell.view.state.vertices.element[shell.view.vertex(vertex)] == kNone) continue;
            Motion3 before;
            uint32_t vertices = 0, edges = 0, elements = 0;
            const SplitResult done = split(shell.view, vertex, seeded_direction(3, n), touched, [&] {
                before = motion_of(shell.view);
                vertices = live_vertex_count(shell.view), edges = edge_count(shell.view);
                elements = shell.view.element_count();
            });
            inserted += done.inserted;
            ASSERT_EQ(broken_rule(shell), "") << body.name << ", split " << n << " at vertex " << vertex;
            if (!done.is_cut) continue;
            ++cuts;
            EXPECT_EQ(shell.view.element_count(), elements);
            // The copies share place and velocity.
            const Motion3 after = motion_of(shell.view);
            const double scale = std::sqrt(2 * before.energy * shell.mass);
            EXPECT_LT(length(after.momentum - before.momentum), 1e-12 * scale);
            EXPECT_LT(length(after.angular - before.angular), 1e-12 * scale);
            EXPECT_NEAR(after.energy, before.energy, 1e-12 * before.energy);
            const int dv = static_cast<int>(live_vertex_count(shell.view)) - static_cast<int>(vertices);
            const int de = static_cast<int>(edge_count(shell.view)) - static_cast<int>(edges);
            EXPECT_EQ(done.ends, done.was_interior ? 2u : 1u);
            EXPECT_EQ(dv - de, (done.was_interior ? -1 : 0) + static_cast<int>(done.on_border))
                << body.name << ", split " << n;
        }
        EXPECT_GT(cuts, 60u) << body.name;
        EXPECT_GT(inserted, 60u) << body.name;
    }
}

TEST(PlaneSplit, SidesAreTwoRunsAndFollowTheCentroids) {
    for (const Body& body : bodies()) {
        Shell shell = make_shell_of(body.surface, 64, 64);
        for (uint32_t v = 0; v < shell.view.vertex_count(); ++v) {
            Ring ring;
            walk_ring(shell.view, v, ring);
            const Vec3 normal = seeded_direction(5, v), place = shell.view.state.vertices.rest[shell.view.vertex(v)];
            const RingSides sides = choose_sides(shell.view, v, ring, normal);
            uint32_t changes = 0, wrong = 0;
            for (uint32_t i = 0; i < ring.count; ++i) {
                const auto& corner = shell.view.state.elements.corner[shell.view.element(ring.element[i])];
                Vec3 middle{};
                for (const uint32_t c : corner)
                    middle += (1.0f / 3) * shell.view.state.vertices.rest[shell.view.vertex(c)];
                wrong += sides.is_above[i] != (dot(normal, middle - place) > 0);
                if (i + 1 < ring.count || ring.is_closed)
                    changes += sides.is_above[i] != sides.is_above[(i + 1) % ring.count];
            }
            if (!sides.was_mended) {
                EXPECT_EQ(wrong, 0u) << body.name << " vertex " << v;
            }
            EXPECT_EQ(sides.is_split, changes == (ring.is_closed ? 2u : 1u)) << body.name << " vertex " << v;
            EXPECT_LE(changes, 2u);
        }
    }
}

TEST(PlaneSplit, APlaneThroughAStraightRowOfEdgesInsertsNothing) {
    Shell shell = make_shell_of(sheet(6, 6, 0.06, 0.06), 64, 64);
    const uint32_t middle = vertex_near(shell.view, {0.03f, 0, 0.03f});
    Ring ring;
    walk_ring(shell.view, middle, ring);
    const auto& corner = shell.view.state.elements.corner[shell.view.element(ring.element[0])];
    const uint32_t next = corner[(ring.corner[0] + 1u) % 3];
    const Vec3 along = normalised(shell.view.state.vertices.rest[shell.view.vertex(next)] -
                                  shell.view.state.vertices.rest[shell.view.vertex(middle)]);
    const Vec3 normal = cross(ring_normal(shell.view, ring), along);
    const PlaneCrossing crossing = find_plane_crossing(shell.view, middle, normal);
    // On the edge's own side the plane meets its far end; across it may meet another vertex or an edge's middle.
    if (crossing.element != kNone) {
        const auto& far = shell.view.state.elements.corner[shell.view.element(crossing.element)];
        EXPECT_NE(far[crossing.edge], next);
        EXPECT_NE(far[(crossing.edge + 1) % 3], next);
    }
}

TEST(PlaneSplit, AFanOfOneElementIsNotSplit) {
    Shell shell = make_shell_of(sheet(1, 1, 0.01, 0.01), 16, 16);
    for (uint32_t v = 0; v < shell.view.vertex_count(); ++v) {
        Ring ring;
        walk_ring(shell.view, v, ring);
        if (ring.count > 1) continue;
        EXPECT_FALSE(choose_sides(shell.view, v, ring, seeded_direction(1, v)).is_split);
    }
}

}  // namespace
}  // namespace cullet::crack_test
