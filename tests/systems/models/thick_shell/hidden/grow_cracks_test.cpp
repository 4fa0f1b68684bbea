// Cracks start, run, join and finish under stresses set by hand.
#include "systems/models/thick_shell/hidden/grow_cracks.hpp"
#include "systems/structures/shell/costs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "engine/random.hpp"
#include "systems/models/thick_shell/hidden/crack_candidates.hpp"
#include "systems/models/thick_shell/hidden/crack_rules.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/models/thick_shell/stiffness/element_stress.hpp"
#include "tests/support/crack_meshes.hpp"

namespace cullet {
namespace {

using namespace crack_test;

constexpr double kStrength = 100e6;  // Pa, sigma_d of the test material: twice 50 MPa

uint32_t count_state(ShellView shell, CrackState state) {
    uint32_t count = 0;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v)
        count += shell.state.vertices.crack[shell.vertex(v)] == static_cast<uint8_t>(state);
    return count;
}

void ban_all(ShellView shell) {
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) shell.state.vertices.is_start_banned[shell.vertex(v)] = 1;
}

// Checks every 20 microseconds with the same field until nothing has moved for five checks. `units`: what the cuts
// cost.
CrackSink run(Shell& shell, Row<Tasks> task, const StressField& field, uint32_t most_checks = 400,
              uint64_t* units = nullptr) {
    CrackSink all;
    uint32_t quiet = 0;
    for (uint32_t i = 0; i < most_checks && quiet < 5; ++i) {
        set_time(shell, task, 20e-6 * i);
        set_stress(shell.view, field);
        CrackSink sink;
        const uint32_t cuts = grow_cracks(*shell.state, task, sink);
        quiet = cuts ? 0 : quiet + 1;
        if (units) *units += units_of_crack(shell.view.vertex_count(), false) * sink.cut_edges;
        all.cut_edges += sink.cut_edges, all.starts += sink.starts, all.inserted += sink.inserted;
        all.refused += sink.refused;
        for (uint32_t e = 0; e < sink.count; ++e) all.add(sink.event[e]);
    }
    return all;
}

TEST(GrowCracks, BelowTheStrengthNothingStarts) {
    Shell shell = make_shell_of(sheet(10, 10, 0.1, 0.1, 0.3), 200, 200);
    const Row<Tasks> task = make_task(shell);
    set_stress(shell.view, [](Vec3, int) { return tension_along({1, 0, 0}, 0.99 * kStrength); });
    const uint64_t before = shell.state->hash();
    CrackSink sink;
    EXPECT_EQ(grow_cracks(*shell.state, task, sink), 0u);
    EXPECT_EQ(shell.state->hash(), before);
}

TEST(GrowCracks, InfiniteStrengthNeverCracks) {
    Shell shell = make_shell_of(sheet(10, 10, 0.1, 0.1, 0.3), 200, 200);
    const Row<Tasks> task = make_task(shell);
    shell.state->vertices.crack[shell.view.vertex(60)] = static_cast<uint8_t>(CrackState::Tip);
    shell.state->vertices.heading.set(shell.view.vertex(60), {1, 0, 0});
    shell.state->tasks.strength_scale[task] = HUGE_VALF;
    EXPECT_EQ(run(shell, task, [](Vec3, int) { return tension_along({1, 0, 0}, 100 * kStrength); }).cut_edges, 0u);
}

TEST(GrowCracks, AStripUnderTensionCracksStraightAcrossAndFallsInTwo) {
    // The middle is the weakest place; the strip's other starts are banned, as they would be by its unloading.
    Shell shell = make_shell_of(sheet(40, 12, 0.2, 0.06, 0.35), 400, 400);
    const Row<Tasks> task = make_task(shell);
    ban_all(shell.view);
    const uint32_t weak = vertex_near(shell.view, {0.1f, 0.03f, 0});
    shell.state->vertices.is_start_banned[shell.view.vertex(weak)] = 0;
    const float x = shell.state->vertices.rest[shell.view.vertex(weak)].x;
    uint64_t units = 0;
    const auto tension = [](Vec3, int) { return tension_along({1, 0, 0}, 1.1 * kStrength); };
    const CrackSink all = run(shell, task, tension, 400, &units);
    EXPECT_EQ(all.starts, 1u);
    EXPECT_EQ(broken_rule(shell), "");
    EXPECT_EQ(component_count(shell.view), 2u);
    EXPECT_EQ(count_state(shell.view, CrackState::Tip), 0u);
    float furthest = 0;
    for (uint32_t v = 0; v < shell.view.vertex_count(); ++v)
        if (shell.state->vertices.crack[shell.view.vertex(v)])
            furthest = std::max(furthest, std::fabs(shell.state->vertices.rest[shell.view.vertex(v)].x - x));
    EXPECT_LT(furthest, 0.8f * shell.view.shells().mean_edge[shell.view.row]);  // 12 rows of edges; heading drifts not
    // Every cut edge of this strip is counted by the task and owes its units.
    EXPECT_EQ(shell.state->tasks.crack_count[task], all.cut_edges);
    EXPECT_EQ(shell.state->tasks.units_owed[task], units);
    EXPECT_GT(units, kUnitsCut * all.cut_edges);
    EXPECT_EQ(shell.state->tasks.start_count[task], 1u);
    EXPECT_EQ(shell.view.structures().has_cracks[shell.view.structure], 1);
}

/// A strip that tears from its middle under 1.1 of the strength, its tips free to fork above this share of it.
struct Torn {
    uint32_t pieces, starts, tips;
    uint64_t hash;
    std::string rule;
};
Torn tear_strip(float branching) {
    Shell shell = make_shell_of(sheet(40, 24, 0.2, 0.12, 0.35), 600, 600);
    MaterialTraits& traits = shell.state->material_traits;
    traits.append(1);
    traits.fracture[0] = static_cast<uint8_t>(FractureKind::Coarse);  // large cracks do not fork
    traits.branching[0] = branching;
    const Row<Tasks> task = make_task(shell);
    ban_all(shell.view);
    for (uint32_t v = 0; v < shell.view.vertex_count(); ++v)
        shell.state->vertices.ready_time[shell.view.vertex(v)] = 1;  // s: for the whole run
    shell.state->vertices.is_start_banned[shell.view.vertex(vertex_near(shell.view, {0.1f, 0.06f, 0}))] = 0;
    const CrackSink all = run(shell, task, [](Vec3, int) { return tension_along({1, 0, 0}, 1.1 * kStrength); });
    traits.branching[0] = 0;  // what the strip has become is compared, not the setting
    return {component_count(shell.view), all.starts, count_state(shell.view, CrackState::Tip), shell.state->hash(),
            broken_rule(shell)};
}

TEST(GrowCracks, TipsForkAboveTheShareOfTheStrengthThatTheMaterialNames) {
    const Torn straight = tear_strip(0), forked = tear_strip(0.5f), out_of_reach = tear_strip(2);
    EXPECT_EQ(straight.pieces, 2u);
    EXPECT_GT(forked.pieces, 2u);
    EXPECT_EQ(forked.starts, 1u) << "all of it is one crack";
    EXPECT_EQ(forked.rule, "");
    EXPECT_EQ(out_of_reach.hash, straight.hash) << "no tip is under twice the strength";
    EXPECT_EQ(tear_strip(0.5f).hash, forked.hash);
}

// A piece keeps its tips and forgets where their cracks started: the distance to it is not known.
TEST(GrowCracks, ATipOfAPieceForksThoughItsStartIsForgotten) {
    const auto tear = [](float branching) {
        Shell shell = make_shell_of(sheet(40, 24, 0.2, 0.12, 0.35), 600, 600);
        MaterialTraits& traits = shell.state->material_traits;
        traits.append(1);
        traits.fracture[0] = static_cast<uint8_t>(FractureKind::Coarse);
        traits.branching[0] = branching;
        const Row<Tasks> task = make_task(shell);
        Vertices& vertices = shell.state->vertices;
        ban_all(shell.view);
        for (uint32_t v = 0; v < shell.view.vertex_count(); ++v) vertices.ready_time[shell.view.vertex(v)] = 1;
        const uint32_t tip = shell.view.vertex(vertex_near(shell.view, {0.1f, 0, 0}));
        vertices.crack[tip] = static_cast<uint8_t>(CrackState::Tip);
        vertices.heading.set(tip, {0, 1, 0});
        vertices.ready_time[tip] = 0;
        vertices.crack_start[tip] = kNone;
        (void)run(shell, task, [](Vec3, int) { return tension_along({1, 0, 0}, 1.1 * kStrength); });
        EXPECT_EQ(broken_rule(shell), "");
        return component_count(shell.view);
    };
    EXPECT_EQ(tear(0), 2u);
    EXPECT_GT(tear(0.5f), 2u);
}

// What cuts and inserts keep up to date row by row is what a pass over the whole shell gives.
TEST(GrowCracks, LinksOfSlopesFollowEveryCutAndStartStrengthsHideNoStart) {
    Shell shell = make_shell_of(sheet(30, 30, 0.2, 0.2, 0.35), 400, 400);
    const Row<Tasks> task = make_task(shell);
    link_slopes(shell.view);
    find_start_strengths(shell.view);
    const CrackSink all = run(shell, task, [](Vec3, int) { return tension_along({1, 0.5f, 0}, 1.1 * kStrength); });
    ASSERT_GT(all.cut_edges, 20u);
    ASSERT_GT(all.inserted, 0u);
    const Elements& elements = shell.state->elements;
    std::vector<std::array<uint32_t, 3>> links;
    std::vector<float> strengths;
    for (uint32_t e = 0; e < shell.view.element_count(); ++e) {
        links.push_back(elements.other_slope[shell.view.element(e)]);
        strengths.push_back(elements.start_strength[shell.view.element(e)]);
    }
    link_slopes(shell.view);
    find_start_strengths(shell.view);
    for (uint32_t e = 0; e < shell.view.element_count(); ++e) {
        ASSERT_EQ(links[e], elements.other_slope[shell.view.element(e)]) << e;
        ASSERT_LE(strengths[e], elements.start_strength[shell.view.element(e)]) << e;
    }
}

TEST(GrowCracks, ObliqueTensionCracksPerpendicularToItself) {
    for (const Vec3 pull : {Vec3{1, 1, 0}, Vec3{1, 0.5f, 0}, Vec3{-1, 2, 0}}) {
        Shell shell = make_shell_of(sheet(30, 30, 0.2, 0.2, 0.35), 400, 400);
        const Row<Tasks> task = make_task(shell);
        ban_all(shell.view);
        const uint32_t weak = vertex_near(shell.view, {0.1f, 0.1f, 0});
        shell.state->vertices.is_start_banned[shell.view.vertex(weak)] = 0;
        const Vec3 place = shell.state->vertices.rest[shell.view.vertex(weak)];
        run(shell, task, [&](Vec3, int) { return tension_along(pull, 1.1 * kStrength); });
        EXPECT_EQ(component_count(shell.view), 2u);
        EXPECT_EQ(broken_rule(shell), "");
        for (uint32_t v = 0; v < shell.view.vertex_count(); ++v) {
            if (!shell.state->vertices.crack[shell.view.vertex(v)]) continue;
            const float off = dot(normalised(pull), shell.state->vertices.rest[shell.view.vertex(v)] - place);
            // Snapping to vertices and refused inserts move the path by parts of an edge.
            EXPECT_LT(std::fabs(off), 2.0f * shell.view.shells().mean_edge[shell.view.row]);
        }
    }
}

uint32_t arms_for(double second_over_first) {
    Shell shell = make_shell_of(sheet(20, 20, 0.2, 0.2, 0.3), 200, 200);
    const Row<Tasks> task = make_task(shell);
    ban_all(shell.view);
    shell.state->vertices.is_start_banned[shell.view.vertex(vertex_near(shell.view, {0.1f, 0.1f, 0}))] = 0;
    set_stress(shell.view, [&](Vec3, int) {
        return tension_along({1, 0, 0}, 1.2 * kStrength) +
               tension_along({0, 1, 0}, 1.2 * second_over_first * kStrength);
    });
    CrackSink sink;
    const uint32_t cuts = grow_cracks(*shell.state, task, sink);
    EXPECT_EQ(broken_rule(shell), "");
    EXPECT_EQ(count_state(shell.view, CrackState::Tip), cuts);
    EXPECT_EQ(count_state(shell.view, CrackState::Cracked), cuts);  // one vertex a fan
    return cuts;
}

TEST(GrowCracks, ATwoAxialFieldOpensFourOrSixArms) {
    EXPECT_EQ(arms_for(0.0), 2u);
    EXPECT_EQ(arms_for(0.4), 2u);
    EXPECT_EQ(arms_for(0.6), 4u);
    EXPECT_EQ(arms_for(0.95), 6u);
}

TEST(GrowCracks, TheFaceWithMoreTensionDecides) {
    Shell shell = make_shell_of(sheet(20, 20, 0.2, 0.2, 0.3), 200, 200);
    const Row<Tasks> task = make_task(shell);
    ban_all(shell.view);
    shell.state->vertices.is_start_banned[shell.view.vertex(vertex_near(shell.view, {0.1f, 0.1f, 0}))] = 0;
    // Bending: the inner face pulls along y, the outer is pressed along y and pulls a little along x.
    set_stress(shell.view, [&](Vec3, int face) {
        return face == 1 ? tension_along({0, 1, 0}, 1.2 * kStrength)
                         : tension_along({1, 0, 0}, 0.5 * kStrength) + tension_along({0, 1, 0}, -2 * kStrength);
    });
    CrackSink sink;
    ASSERT_EQ(grow_cracks(*shell.state, task, sink), 2u);
    for (uint32_t v = 0; v < shell.view.vertex_count(); ++v) {
        if (shell.state->vertices.crack[shell.view.vertex(v)] != static_cast<uint8_t>(CrackState::Tip)) continue;
        EXPECT_GT(std::fabs(shell.state->vertices.heading[shell.view.vertex(v)].x), 0.999f);
    }
}

TEST(GrowCracks, NoStartWithinThreeEdgesOfACutAndTipsGoOnBelowTheStrength) {
    Shell shell = make_shell_of(sheet(40, 40, 0.2, 0.2, 0.3), 600, 600);
    const Row<Tasks> task = make_task(shell);
    const StressField field = [](Vec3, int) { return tension_along({1, 0, 0}, 1.2 * kStrength); };
    set_stress(shell.view, field);
    CrackSink sink;
    grow_cracks(*shell.state, task, sink);
    EXPECT_GT(sink.starts, 5u);
    EXPECT_EQ(broken_rule(shell), "");
    const float l = shell.view.shells().mean_edge[shell.view.row];
    for (uint32_t a = 0; a < sink.count; ++a)
        for (uint32_t b = 0; b < a; ++b)
            EXPECT_GT(length(sink.event[a].place - sink.event[b].place), kStartSpacing * l);
    // Griffith's limit of the test material is far below its strength; nothing else starts at a third of it.
    const CrackLimits limits = crack_limits(shell.view, 1);
    ASSERT_LT(limits.tip, 0.3f * limits.start);
    set_time(shell, task, 1e-3);
    set_stress(shell.view, [](Vec3, int) { return tension_along({1, 0, 0}, 0.3 * kStrength); });
    CrackSink later;
    grow_cracks(*shell.state, task, later);
    EXPECT_EQ(later.starts, 0u);
    EXPECT_GT(later.cut_edges, 5u);
    for (uint32_t e = 0; e < later.count; ++e) EXPECT_EQ(later.event[e].kind, CrackEventKind::Advance);
}

TEST(GrowCracks, TheMostOverloadedVertexStartsFirst) {
    Shell shell = make_shell_of(sheet(40, 40, 0.2, 0.2, 0.3), 600, 600);
    const Row<Tasks> task = make_task(shell);
    set_stress(shell.view, [](Vec3 p, int) { return tension_along({1, 0, 0}, (1.1 + p.x) * kStrength); });
    CrackSink sink;
    grow_cracks(*shell.state, task, sink);
    ASSERT_GT(sink.count, 3u);
    for (uint32_t i = 1; i < sink.count; ++i) EXPECT_LE(sink.event[i].stress, sink.event[i - 1].stress);
    EXPECT_GT(sink.event[0].place.x, 0.19f);
}

TEST(GrowCracks, ATipWaitsUntilItsCrackCanHaveComeThere) {
    Shell shell = make_shell_of(sheet(20, 20, 0.2, 0.2, 0.3), 300, 300);
    const Row<Tasks> task = make_task(shell);
    ban_all(shell.view);
    shell.state->vertices.is_start_banned[shell.view.vertex(vertex_near(shell.view, {0.1f, 0.1f, 0}))] = 0;
    const StressField field = [](Vec3, int) { return tension_along({1, 0, 0}, 1.2 * kStrength); };
    set_stress(shell.view, field);
    CrackSink sink;
    ASSERT_EQ(grow_cracks(*shell.state, task, sink), 2u);
    const double speed = kTipSpeed * std::sqrt(70e9 / 2400);
    double shortest = 1;
    for (uint32_t v = 0; v < shell.view.vertex_count(); ++v)
        if (shell.state->vertices.crack[shell.view.vertex(v)] == static_cast<uint8_t>(CrackState::Tip)) {
            const double away = length(shell.state->vertices.rest[shell.view.vertex(v)] - sink.event[0].place);
            EXPECT_NEAR(shell.state->vertices.ready_time[shell.view.vertex(v)], away / speed, 1e-9);
            shortest = std::min(shortest, away / speed);
        }
    set_time(shell, task, shortest - 2e-6);
    set_stress(shell.view, field);
    EXPECT_EQ(grow_cracks(*shell.state, task, sink), 0u);
    set_time(shell, task, 1e-4);
    EXPECT_EQ(grow_cracks(*shell.state, task, sink), 2u);
}

TEST(GrowCracks, TwoCracksThatComeNearEachOtherJoin) {
    // Two starts on lines 1.2 edges apart, both running along x: the tips that meet turn to each other's crack.
    Shell shell = make_shell_of(sheet(60, 30, 0.3, 0.15, 0.3), 800, 800);
    const Row<Tasks> task = make_task(shell);
    const float l = shell.view.shells().mean_edge[shell.view.row];
    ban_all(shell.view);
    const uint32_t a = vertex_near(shell.view, {0.1f, 0.075f, 0}),
                   b = vertex_near(shell.view, {0.2f, 0.075f + 1.2f * l, 0});
    for (const uint32_t v : {a, b}) shell.state->vertices.is_start_banned[shell.view.vertex(v)] = 0;
    const CrackSink all = run(shell, task, [](Vec3, int) { return tension_along({0, 1, 0}, 1.1 * kStrength); });
    EXPECT_EQ(all.starts, 2u);
    EXPECT_EQ(component_count(shell.view), 2u);
    EXPECT_EQ(count_state(shell.view, CrackState::Tip), 0u);
    EXPECT_EQ(broken_rule(shell), "");
}

TEST(GrowCracks, AStarOnASphereKeepsItsArmsApart) {
    Shell shell = make_shell_of(sphere(4, 0.1), 600, 1200);
    const Row<Tasks> task = make_task(shell);
    ban_all(shell.view);
    const uint32_t pole = vertex_near(shell.view, {0.03f, 0.09f, 0.02f});
    const Vec3 place = shell.state->vertices.rest[shell.view.vertex(pole)];
    shell.state->vertices.is_start_banned[shell.view.vertex(pole)] = 0;
    // Hoop tension round the pole: cracks run along meridians.
    const Vec3d axis = normalised(Vec3d(place));
    const CrackSink all = run(
        shell, task,
        [&](Vec3 p, int) {
            const Vec3d out = Vec3d(p) - dot(Vec3d(p), axis) * axis;
            if (length(out) < 0.02) return 1.2 * kStrength * Sym3d{1, 1, 1, 0, 0, 0};
            return 0.5 * kStrength * outer(normalised(cross(axis, out)));
        },
        12);
    EXPECT_EQ(all.starts, 1u);
    EXPECT_EQ(count_state(shell.view, CrackState::Tip), 6u);
    EXPECT_EQ(broken_rule(shell), "");
    EXPECT_EQ(component_count(shell.view), 1u);
}

TEST(GrowCracks, AShellWithoutRoomRefusesAndCountsAndNothingIsBroken) {
    for (const uint32_t spare : {0u, 1u, 2u, 5u, 17u}) {
        Shell shell = make_shell_of(sheet(20, 20, 0.2, 0.2, 0.3), spare, spare);
        const Row<Tasks> task = make_task(shell);
        const CrackSink all = run(
            shell, task,
            [](Vec3, int) {
                return tension_along({1, 0.3f, 0}, 1.2 * kStrength);
            },
            60);
        EXPECT_GT(all.refused, 0u);
        EXPECT_LE(shell.view.vertex_count(), shell.view.vertices().capacity);
        EXPECT_LE(shell.view.element_count(), shell.view.elements().capacity);
        EXPECT_EQ(broken_rule(shell), "");
    }
}

TEST(GrowCracks, StressesThatAreNoNumbersBreakNothing) {
    Shell shell = make_shell_of(sphere(3, 0.1), 400, 400);
    const Row<Tasks> task = make_task(shell);
    for (const float bad : {NAN, HUGE_VALF, -HUGE_VALF}) {
        set_stress(shell.view, [](Vec3, int) { return tension_along({1, 0, 0}, 0.1 * kStrength); });
        for (uint32_t e = 0; e < shell.view.element_count(); e += 3) {
            shell.state->elements.outer_stress.set(shell.view.element(e), {bad, bad, bad});
            shell.state->elements.principal[shell.view.element(e)] = std::fabs(bad);
        }
        CrackSink sink;
        grow_cracks(*shell.state, task, sink);
        EXPECT_EQ(broken_rule(shell), "");
        set_stress(shell.view, [](Vec3, int) { return Sym3d{}; });
        EXPECT_EQ(shell.state->validate(), "");
    }
}

TEST(GrowCracks, EverythingBreaksAtOnceAndStillEveryRuleHolds) {
    Shell shell = make_shell_of(sphere(5, 0.1), 8000, 8000);
    const Row<Tasks> task = make_task(shell);
    set_stress(shell.view, [](Vec3, int) { return 1000 * kStrength * Sym3d{1, 1, 1, 0, 0, 0}; });
    CrackSink sink;
    EXPECT_GT(grow_cracks(*shell.state, task, sink), 100u);
    EXPECT_EQ(sink.count + sink.dropped, sink.starts);
    EXPECT_EQ(broken_rule(shell), "");
}

// A smooth field that differs from check to check: three random waves of random tensors.
StressField random_field(uint64_t seed, float size) {
    struct Wave {
        Vec3 k;
        Sym3d t;
    };
    std::array<Wave, 3> waves;
    const Random random{seed};
    for (uint32_t w = 0; w < 3; ++w) {
        const auto draw = [&](uint32_t i) { return 2 * random.uniform(w, i) - 1; };
        waves[w].k = (8 / size) * Vec3{float(draw(0)), float(draw(1)), float(draw(2))};
        waves[w].t = 1.2 * kStrength * Sym3d{draw(3), draw(4), draw(5), draw(6), draw(7), draw(8)};
    }
    return [waves](Vec3 p, int face) {
        Sym3d sum;
        for (const Wave& w : waves) {
            double s, c;
            sine_cosine(double{dot(w.k, p)} + face, s, c);
            sum = sum + s * w.t;
        }
        return sum;
    };
}

// T9, T12, links, momenta and energy after each of many checks with fields of their own.
void hit_at_random(const TestSurface& surface, float size, uint64_t seed, uint32_t hits, uint32_t least_cuts) {
    Shell shell = make_shell_of(surface, 6000, 6000);
    const Row<Tasks> task = make_task(shell);
    shake(shell.view, seed);
    const Motion3 start = motion_of(shell.view);
    double energy = start.energy;
    uint32_t cuts = 0;
    for (uint32_t hit = 0; hit < hits; ++hit) {
        set_time(shell, task, 20e-6 * (hit % 50));
        if (hit % 50 == 0) begin_cracks(shell.view, hit % 100 == 50);
        set_stress(shell.view, random_field(seed + hit, size));
        CrackSink sink;
        cuts += grow_cracks(*shell.state, task, sink);
        ASSERT_EQ(broken_rule(shell), "") << "hit " << hit;
        const Motion3 now = motion_of(shell.view);
        ASSERT_LE(now.energy, energy * (1 + 1e-7));
        energy = now.energy;
        ASSERT_LT(length(now.momentum - start.momentum), 1e-5 * length(start.momentum));
    }
    EXPECT_GT(cuts, least_cuts);
    EXPECT_EQ(shell.state->validate(), "");
}

TEST(GrowCracks, AThousandRandomHitsKeepEveryRule) {
    hit_at_random(sphere(3, 0.1), 0.1f, 100, 250, 100);
    hit_at_random(sheet(24, 16, 0.3, 0.2, 0.3), 0.3f, 1100, 250, 100);
    hit_at_random(closed_lathe(24, 16, 0.1, 0.3), 0.2f, 2100, 250, 100);
    hit_at_random(sheet(3, 3, 0.03, 0.03), 0.03f, 3100, 250, 8);
}

TEST(GrowCracks, TheSameStressesGiveTheSameBytes) {
    uint64_t hash[2];
    for (uint64_t& h : hash) {
        Shell shell = make_shell_of(sphere(4, 0.1), 1000, 1000);
        const Row<Tasks> task = make_task(shell);
        for (uint32_t i = 0; i < 20; ++i) {
            set_time(shell, task, 20e-6 * i);
            set_stress(shell.view, random_field(50 + i, 0.1f));
            CrackSink sink;
            grow_cracks(*shell.state, task, sink);
        }
        h = shell.state->hash();
    }
    EXPECT_EQ(hash[0], hash[1]);
}

TEST(BeginCracks, AFragmentKeepsItsTipsAndForgetsItsOtherCracks) {
    Shell shell = make_shell_of(sheet(20, 20, 0.2, 0.2, 0.3), 300, 300);
    const Row<Tasks> task = make_task(shell);
    run(
        shell, task,
        [](Vec3, int) {
            return tension_along({1, 0, 0}, 1.2 * kStrength);
        },
        2);
    const uint32_t tips = count_state(shell.view, CrackState::Tip);
    ASSERT_GT(tips, 0u);
    ASSERT_GT(count_state(shell.view, CrackState::Cracked), 0u);
    begin_cracks(shell.view, true);
    EXPECT_EQ(count_state(shell.view, CrackState::Tip), tips);
    EXPECT_EQ(count_state(shell.view, CrackState::Cracked), 0u);
    for (uint32_t v = 0; v < shell.view.vertex_count(); ++v) {
        EXPECT_EQ(shell.state->vertices.is_start_banned[shell.view.vertex(v)], 0);
        EXPECT_EQ(shell.state->vertices.ready_time[shell.view.vertex(v)], 0);
    }
}

}  // namespace
}  // namespace cullet
