#include "components/state.hpp"

#include <gtest/gtest.h>

#include "engine/random.hpp"
#include "systems/structures/shell/cook/apply_pins.hpp"
#include "systems/structures/shell/crack_touches.hpp"
#include "systems/structures/shell/make_piece.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "tests/support/hand_off.hpp"
#include "tests/support/sample_shells.hpp"

namespace cullet {
namespace {

struct Hit {
    State state;
    Row<Structures> intact, shell;
    std::vector<FragmentPart> parts;
    std::vector<PartMotion> motions;
    HandoffStart start{{0.5, -5, 0.25}, {1, 2, -3}, {}, 5};

    explicit Hit(uint64_t seed, double noise = 6, bool is_pinned = false) {
        const auto built = build_shell(state, sample_vase(0.3, 0.005, 48, 40).source(), sample_material(state));
        EXPECT_TRUE(built.ok()) << built.error();
        intact = built.value();
        if (is_pinned) apply_pins(ShellView(state, intact), {-1, -1, -1}, {1, 0.01f, 1});
        shell = cut_by_label(state, intact, nearest_seed(ShellView(state, intact), 12, seed));
        start.centre = state.structures.centre[intact];
        parts.resize(1000);
        parts.resize(group_fragments(view(), parts));
        motions.resize(parts.size());
        shake(seed, noise);
    }
    ShellView view() { return ShellView(state, shell); }
    void shake(uint64_t seed, double noise) {
        const Random random{seed};
        for (uint32_t v = 0; v < view().vertex_count(); ++v) {
            const uint32_t row = view().vertex(v);
            if (state.vertices.element[row] == kNone || state.vertices.is_pinned[row]) continue;
            const uint32_t part = state.elements.part[view().element(state.vertices.element[row])];
            const auto swing = [&](uint32_t of, uint32_t k) { return noise * (2 * random.uniform(of, k) - 1); };
            Vec3d u = start.velocity + cross(start.spin, Vec3d(state.vertices.rest[row]) - start.centre);
            // Half of each vertex's own, half of the part's: shards that leave, and some very fast.
            u += Vec3d(swing(v, 0), swing(v, 1), swing(v, 2)) +
                 2.0 * Vec3d(swing(part, 7), swing(part, 8), swing(part, 9));
            state.vertices.velocity.set(row, u.to_float());
        }
    }
    /// Momentum, and angular momentum about the body frame's origin, of the hidden state of one part or all.
    std::pair<Vec3d, Vec3d> hidden_momenta(uint32_t part) {
        Vec3d p, l;
        for (uint32_t v = 0; v < view().vertex_count(); ++v) {
            const uint32_t row = view().vertex(v);
            const uint32_t e = state.vertices.element[row];
            if (e == kNone || (part != kNone && state.elements.part[view().element(e)] != part)) continue;
            const Vec3d mv = state.vertices.mass[row] * Vec3d(state.vertices.velocity[row]);
            p += mv;
            l += cross(Vec3d(state.vertices.rest[row]), mv);
        }
        return {p, l};
    }
};

// Edges that were cut between two parts, counted from the shell before: two touches each.
uint32_t edges_between_parts(Hit& hit) {
    const State& state = hit.state;
    const ShellView before(hit.state, hit.intact), after = hit.view();
    uint32_t count = 0;
    for (uint32_t e = 0; e < before.element_count(); ++e)
        for (const uint32_t n : state.elements.neighbour[before.element(e)])
            count +=
                n != kNone && n > e && state.elements.part[after.element(e)] != state.elements.part[after.element(n)];
    return count;
}

void mark_cracks(Hit& hit) {
    Elements& elements = hit.state.elements;
    for (uint32_t e = 0; e < hit.view().element_count(); ++e)
        for (uint32_t k = 0; k < 3; ++k)
            if (elements.neighbour[hit.view().element(e)][k] == kNone)
                elements.edge_kind[hit.view().element(e)][k] = static_cast<uint8_t>(EdgeKind::Crack);
}

double closing(std::span<const PartMotion> motions, const Touches& touches, uint32_t t) {
    const auto velocity = [&](uint32_t p) {
        return motions[p].velocity + cross(motions[p].spin, touches.point[t] - motions[p].centre);
    };
    return dot(velocity(touches.b[t]) - velocity(touches.a[t]), touches.normal[t]);
}

TEST(RigidHandoff, PartsAreNotBornOnTheirWayIntoEachOtherAndKeepTheirMomentaTogether) {
    Arena arena(1 << 24);
    for (uint64_t seed = 1; seed <= 20; ++seed) {
        Hit hit(seed);
        hit.start.impact_speed = 1e9;  // no clamps
        test::hand_off(hit.view(), hit.start, hit.parts, hit.motions);
        mark_cracks(hit);
        Touches touches;
        hit.start.touches = crack_touches(hit.view(), Row<Fragments>(0), false, touches, arena);
        EXPECT_EQ(touches.size(), 4 * edges_between_parts(hit));
        EXPECT_EQ(hit.start.touches.count, touches.size());
        double before = 0, after = 0;
        for (uint32_t t = 0; t < touches.size(); ++t) before = std::max(before, closing(hit.motions, touches, t));
        hit.start.impact_speed = 100;  // what stop_approach measures by, still without clamps
        const HandoffReport report = test::hand_off(hit.view(), hit.start, hit.parts, hit.motions, {}, &touches);
        const auto [p, l] = hit.hidden_momenta(kNone);
        Vec3d momentum, turning;
        double size = 0;
        for (const PartMotion& m : hit.motions) {
            const Vec3d own = cross(m.centre, m.mass * m.velocity) + m.inertia * m.spin;
            momentum += m.mass * m.velocity;
            turning += own;
            size += length(own);
        }
        EXPECT_LT(length(momentum - p), 1e-9 * length(p));
        EXPECT_GT(report.energy_crushed, 0);
        EXPECT_LE(report.energy_unclamped + report.energy_crushed, report.energy_hidden);
        ASSERT_EQ(report.spin_clamps + report.speed_clamps, 0u);
        EXPECT_LT(length(turning - l), 1e-6 * size);
        for (uint32_t t = 0; t < touches.size(); ++t) after = std::max(after, closing(hit.motions, touches, t));
        EXPECT_LT(after, 0.05 * before);
    }
}

TEST(RigidHandoff, MomentaAreTheHiddenStatesAndEnergyDoesNotRise) {
    for (uint64_t seed = 1; seed <= 20; ++seed) {
        Hit hit(seed);
        hit.start.impact_speed = 1e9;  // no clamps
        const HandoffReport report = test::hand_off(hit.view(), hit.start, hit.parts, hit.motions);
        EXPECT_EQ(report.speed_clamps + report.spin_clamps, 0u);
        for (uint32_t part = 0; part < hit.parts.size(); ++part) {
            const PartMotion& m = hit.motions[part];
            const auto [p, l] = hit.hidden_momenta(part);
            EXPECT_NEAR(m.mass / hit.parts[part].mass, 1, 1e-12);
            EXPECT_LT(length(m.mass * m.velocity - p), 1e-12 * length(p));
            const Vec3d own = cross(m.centre, m.mass * m.velocity) + m.inertia * m.spin;
            EXPECT_LT(length(own - l), 1e-6 * length(l));
            const double energy = m.mass / 2 * dot(m.velocity, m.velocity) + dot(m.spin, m.inertia * m.spin) / 2;
            EXPECT_LE(energy, m.hidden_energy * (1 + 1e-12));
        }
        EXPECT_LE(report.energy_unclamped, report.energy_hidden);
        EXPECT_EQ(report.energy_after, report.energy_unclamped);
    }
}

TEST(RigidHandoff, ARigidMotionComesBackExactly) {
    Hit hit(3, 0);
    const HandoffReport report = test::hand_off(hit.view(), hit.start, hit.parts, hit.motions);
    EXPECT_EQ(report.speed_clamps + report.spin_clamps, 0u);
    for (const PartMotion& m : hit.motions) {
        EXPECT_LT(length(m.spin - hit.start.spin), 1e-4);
        EXPECT_LT(length(m.velocity - hit.start.velocity - cross(hit.start.spin, m.centre - hit.start.centre)), 1e-6);
    }
    EXPECT_NEAR(report.energy_after / report.energy_hidden, 1, 1e-6);
}

TEST(RigidHandoff, ClampsHoldAndMomentumIsExactWithThem) {
    uint32_t speeds = 0, spins = 0;
    double worst_rise = 0, largest_gain = 0;
    for (uint64_t seed = 1; seed <= 20; ++seed) {
        Hit hit(seed);
        const HandoffReport report = test::hand_off(hit.view(), hit.start, hit.parts, hit.motions);
        speeds += report.speed_clamps, spins += report.spin_clamps;
        const Vec3d hidden = hit.hidden_momenta(kNone).first;
        Vec3d after;
        for (uint32_t p = 0; p < hit.parts.size(); ++p) {
            const PartMotion& m = hit.motions[p];
            after += m.mass * m.velocity;
            const Vec3d before = hit.start.velocity + cross(hit.start.spin, m.centre - hit.start.centre);
            EXPECT_TRUE(p == report.largest || length(m.velocity - before) <= 10 * (1 + 1e-12));
            const double rim = std::min(length(m.spin - hit.start.spin), length(m.spin)) * m.radius;
            EXPECT_LE(rim, 10 * (1 + 1e-12));
        }
        EXPECT_LT(length(after - hidden), 1e-12 * length(hidden));
        EXPECT_LT(length(report.momentum_after - report.momentum_before), 1e-12 * length(hidden));
        EXPECT_EQ(report.support_momentum, Vec3d());
        worst_rise = std::max(worst_rise, report.energy_after / report.energy_hidden);
        largest_gain = std::max(largest_gain, length(hit.motions[report.largest].velocity - hit.start.velocity));
    }
    EXPECT_GT(speeds, 0u);
    EXPECT_LE(worst_rise, 1);
    std::printf("20 hits: %u speed clamps, %u spin clamps, energy at most %.2f of the hidden state's\n", speeds, spins,
                worst_rise);
}

TEST(RigidHandoff, WhatAPinnedLargestPartGetsGoesToTheGround) {
    for (uint64_t seed = 1; seed <= 10; ++seed) {
        Hit hit(seed, 6, true);
        // The part that stands on its foot is made the largest.
        uint32_t pinned = kNone;
        for (uint32_t p = 0; p < hit.parts.size(); ++p)
            if (hit.parts[p].has_pins) pinned = p;
        ASSERT_NE(pinned, kNone);
        hit.parts[pinned].mass = 100;
        const HandoffReport report = test::hand_off(hit.view(), hit.start, hit.parts, hit.motions);
        EXPECT_EQ(report.largest.index, pinned);
        EXPECT_EQ(hit.motions[pinned].velocity, Vec3d());
        EXPECT_EQ(hit.motions[pinned].spin, Vec3d());
        const Vec3d sum = report.momentum_after + report.support_momentum;
        EXPECT_LT(length(sum - report.momentum_before), 1e-12 * length(report.momentum_before));
        EXPECT_LE(report.energy_after, report.energy_hidden);
    }
}

// |(I_tetrahedra - I_vertices) w| / |I_vertices w|: how much angular momentum changes when the rigid body takes over
// with the inertia of the piece's tetrahedra. 0 without spin.
double inertia_change(const PartMotion& motion, const Sym3d& tetrahedra_inertia) {
    const double own = length(motion.inertia * motion.spin);
    return own > 0 ? length((tetrahedra_inertia - motion.inertia) * motion.spin) / own : 0;
}

TEST(RigidHandoff, TetrahedraAndVerticesHaveAlikeInertia) {
    Hit hit(4, 2);
    test::hand_off(hit.view(), hit.start, hit.parts, hit.motions);
    double worst = 0, worst_shift = 0;
    for (uint32_t p = 0; p < hit.parts.size(); ++p) {
        const Row<Structures> piece = make_piece(hit.state, hit.shell, hit.parts[p], 1);
        if (hit.parts[p].element_count < 12) continue;
        worst = std::max(worst, inertia_change(hit.motions[p], hit.state.structures.inertia[piece]));
        worst_shift = std::max(
            worst_shift, length(hit.motions[p].centre - hit.state.structures.centre[piece]) / hit.motions[p].radius);
    }
    std::printf("inertia changes L by at most %.1f %%, centres differ by %.1f %% of the radius\n", 100 * worst,
                100 * worst_shift);
    EXPECT_LT(worst, 0.5);
    EXPECT_LT(worst_shift, 0.1);
}

TEST(RigidHandoff, OneTriangleNeitherSpinsNorGainsEnergy) {
    State state;
    const auto built = build_shell(state, sample_grid(0.1, 0.1, 1, 1, 0.004).source(), sample_material(state));
    const ShellView intact(state, built.value());
    const Row<Structures> cut = cut_by_label(state, built.value(), [](uint32_t e) { return static_cast<int>(e); });
    const ShellView shell(state, cut);
    std::vector<FragmentPart> parts(2);
    ASSERT_EQ(group_fragments(shell, parts), 2u);
    std::vector<PartMotion> motions;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v)
        state.vertices.velocity.set(shell.vertex(v), {static_cast<float>(v), 1, static_cast<float>(v * v)});
    const HandoffReport report = test::hand_off(shell, {{}, {}, {}, 1000}, parts, motions);
    EXPECT_LE(report.energy_after, report.energy_hidden * (1 + 1e-12));
    EXPECT_LT(length(report.momentum_after - report.momentum_before), 1e-12);
}

}  // namespace
}  // namespace cullet
