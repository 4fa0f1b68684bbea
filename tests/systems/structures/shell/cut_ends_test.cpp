// Cutting edges and splitting vertices: counts, links, masses, momenta (thick shell note C3, T7 to T9).
#include "systems/structures/shell/cut_ends.hpp"

#include <gtest/gtest.h>

#include "engine/random.hpp"
#include "systems/models/thick_shell/stiffness/refresh.hpp"
#include "systems/structures/shell/cut_edge.hpp"
#include "systems/structures/shell/insert_vertex.hpp"
#include "systems/structures/shell/split_fans.hpp"
#include "tests/support/crack_meshes.hpp"

namespace cullet {
namespace {

using namespace crack_test;

struct Counts {
    int vertices, edges;
    explicit Counts(ShellView s) : vertices(int(live_vertex_count(s))), edges(int(edge_count(s))) {}
};

Ends ends_of(std::initializer_list<uint32_t> list) {
    Ends ends;
    for (const uint32_t v : list) ends.add(v);
    return ends;
}

// Vertices at the other ends of the interior edges of a vertex.
std::vector<uint32_t> interior_ends(ShellView shell, uint32_t vertex) {
    Ring ring;
    walk_ring(shell, vertex, ring);
    std::vector<uint32_t> found;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const uint32_t row = shell.element(ring.element[i]);
        if (shell.state.elements.neighbour[row][ring.corner[i]] == kNone) continue;
        found.push_back(shell.state.elements.corner[row][(ring.corner[i] + 1) % 3]);
    }
    return found;
}

TEST(CutEnds, TwoCutsInsideOpenASlitAndVerticesMinusEdgesFallByOne) {
    Shell shell = make_shell_of(sheet(8, 8, 1, 1), 8, 0);
    const uint32_t v = vertex_near(shell.view, {0.5f, 0.5f, 0});
    Ends ends = ends_of({v - 1, v + 1});
    Touched touched{kStiffnessRepair};
    const Counts before(shell.view);
    ASSERT_EQ(cut_ends(shell.view, v, ends, touched), CutOutcome::Cut);
    const Counts after(shell.view);
    EXPECT_EQ(after.vertices - before.vertices, 1);
    EXPECT_EQ(after.edges - before.edges, 2);
    EXPECT_TRUE(ends.is_interior[0] && ends.is_interior[1]);
    EXPECT_EQ(broken_rule(shell), "");
    EXPECT_EQ(component_count(shell.view), 1u);
}

TEST(CutEnds, OneCutFromTheBorderKeepsVerticesMinusEdges) {
    Shell shell = make_shell_of(sheet(8, 8, 1, 1), 8, 0);
    const uint32_t v = vertex_near(shell.view, {0.5f, 0, 0});
    Ends ends = ends_of({v + 9});
    Touched touched{kStiffnessRepair};
    const Counts before(shell.view);
    ASSERT_EQ(cut_ends(shell.view, v, ends, touched), CutOutcome::Cut);
    const Counts after(shell.view);
    EXPECT_EQ(after.vertices - before.vertices, 1);
    EXPECT_EQ(after.edges - before.edges, 1);
    EXPECT_EQ(broken_rule(shell), "");
}

TEST(CutEnds, EndsOnTheBorderAddOneVertexEachAndAPieceComesOff) {
    Shell shell = make_shell_of(sheet(2, 2, 1, 1), 8, 0);
    const uint32_t v = vertex_near(shell.view, {0.5f, 0.5f, 0});
    Ends ends = ends_of({v - 1, v + 1});
    Touched touched{kStiffnessRepair};
    const Counts before(shell.view);
    ASSERT_EQ(cut_ends(shell.view, v, ends, touched), CutOutcome::Cut);
    const Counts after(shell.view);
    EXPECT_EQ((after.vertices - after.edges) - (before.vertices - before.edges), 1);  // -1 and twice +1
    EXPECT_EQ(component_count(shell.view), 2u);
    EXPECT_EQ(broken_rule(shell), "");
}

TEST(CutEnds, OneCutInsideIsRefusedAndNothingChanges) {
    Shell shell = make_shell_of(sphere(2, 0.1), 8, 0);
    const uint64_t before = shell.state->hash();
    const auto ends_at = interior_ends(shell.view, 20);
    Ends ends = ends_of({ends_at[0]});
    Touched touched{kStiffnessRepair};
    EXPECT_EQ(cut_ends(shell.view, 20, ends, touched), CutOutcome::Impossible);
    EXPECT_EQ(shell.state->hash(), before);
}

TEST(CutEnds, AShellWithoutRoomRefusesTheCutAndNothingChanges) {
    Shell shell = make_shell_of(sheet(4, 4, 1, 1), 0, 0);
    const uint32_t v = vertex_near(shell.view, {0.5f, 0.5f, 0});
    const uint64_t before = shell.state->hash();
    Ends ends = ends_of({v - 1, v + 1});
    Touched touched{kStiffnessRepair};
    EXPECT_EQ(cut_ends(shell.view, v, ends, touched), CutOutcome::Full);
    EXPECT_EQ(shell.state->hash(), before);
}

TEST(CutEnds, ASingleTriangleCannotBeCut) {
    TestSurface one;
    one.place = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    one.triangle = {{0, 1, 2}};
    Shell shell = make_shell_of(one, 8, 8);
    Touched touched{kStiffnessRepair};
    for (uint32_t v = 0; v < 3; ++v) {
        Ends ends = ends_of({(v + 1) % 3});
        EXPECT_EQ(cut_ends(shell.view, v, ends, touched), CutOutcome::Impossible);
    }
}

TEST(CutEnds, CopiesKeepPlaceVelocityAndPin) {
    Shell shell = make_shell_of(sheet(8, 8, 1, 1), 8, 0);
    shake(shell.view, 3);
    const uint32_t v = vertex_near(shell.view, {0.5f, 0.5f, 0});
    shell.state->vertices.is_pinned[shell.view.vertex(v)] = 1;
    Ends ends = ends_of({v - 1, v + 1});
    Touched touched{kStiffnessRepair};
    const uint32_t copy = shell.view.vertex_count();
    ASSERT_EQ(cut_ends(shell.view, v, ends, touched), CutOutcome::Cut);
    const Vertices& t = shell.state->vertices;
    EXPECT_TRUE(t.velocity[shell.view.vertex(copy)] == t.velocity[shell.view.vertex(v)]);
    EXPECT_TRUE(t.rest[shell.view.vertex(copy)] == t.rest[shell.view.vertex(v)]);
    EXPECT_EQ(t.inverse_mass[shell.view.vertex(copy)], 0);
    EXPECT_EQ(t.inverse_mass[shell.view.vertex(v)], 0);
}

// Random cuts of one to six edges at random vertices, every third time an insertion first, until nothing is left to cut
// or `rounds` are done. After each: all rules.
void cut_at_random(const TestSurface& surface, uint64_t seed, uint32_t rounds, uint32_t check_every) {
    Shell shell = make_shell_of(surface, 4 * rounds + 64, 2 * rounds + 64);
    const ShellView view = shell.view;
    shake(view, seed);
    const Random random{seed};
    const Motion3 start = motion_of(view);
    double energy = start.energy;
    uint32_t cuts = 0, inserts = 0;
    for (uint32_t round = 0; round < rounds; ++round) {
        Touched touched{kStiffnessRepair};
        if (round % 3 == 0) {
            const uint32_t e = static_cast<uint32_t>(random.bits(round, 1) % view.element_count());
            const uint32_t k = static_cast<uint32_t>(random.bits(round, 2) % 3);
            const float tau = static_cast<float>(0.25 + 0.5 * random.uniform(round, 3));
            bool is_full;
            if (can_insert(view, e, k, tau, is_full)) {
                insert_vertex(view, e, k, tau, touched);
                ++inserts;
            }
            ASSERT_FALSE(is_full);
            touched.clear();
        }
        const uint32_t v = static_cast<uint32_t>(random.bits(round, 4) % view.vertex_count());
        const auto candidates = interior_ends(view, v);
        Ends ends;
        for (uint32_t i = 0; i < 1 + random.bits(round, 5) % 4; ++i)
            if (!candidates.empty()) ends.add(candidates[random.bits(round, 6 + i) % candidates.size()]);
        const CutOutcome outcome = cut_ends(view, v, ends, touched);
        ASSERT_NE(outcome, CutOutcome::Full);
        cuts += outcome == CutOutcome::Cut;
        if (round % check_every && round + 1 < rounds) continue;
        ASSERT_EQ(broken_rule(shell), "") << "round " << round;
        const Motion3 now = motion_of(view);
        ASSERT_LE(now.energy, energy * (1 + 1e-7)) << "round " << round;
        energy = now.energy;
        ASSERT_LT(length(now.momentum - start.momentum), 1e-7 * length(start.momentum) * (1 + 1e-3 * round));
    }
    EXPECT_GT(cuts, rounds / 20);
    EXPECT_GT(inserts, rounds / 30);
    EXPECT_EQ(shell.state->validate(), "");
}

TEST(CutEnds, ThousandsOfRandomCutsAndInsertsKeepEveryRuleOnASheet) {
    cut_at_random(sheet(24, 24, 1, 1, 0.3), 1, 4000, 16);
}
TEST(CutEnds, ThousandsOfRandomCutsAndInsertsKeepEveryRuleOnASphere) {
    cut_at_random(sphere(4, 0.1), 2, 4000, 16);
}
TEST(CutEnds, ThousandsOfRandomCutsAndInsertsKeepEveryRuleOnAClosedLathe) {
    cut_at_random(closed_lathe(36, 24, 0.1, 0.4), 3, 4000, 16);
}
TEST(CutEnds, RandomCutsKeepEveryRuleAfterEachSingleCut) {
    cut_at_random(sphere(2, 0.1), 4, 300, 1);
    cut_at_random(sheet(3, 3, 1, 1), 5, 200, 1);
}

TEST(CutEnds, CuttingEveryEdgeLeavesEveryElementAlone) {
    Shell shell = make_shell_of(sphere(2, 0.1), 3 * 128, 0);
    Touched touched{kStiffnessRepair};
    // Each vertex once or more: all its interior edges, one or two at a time.
    for (int pass = 0; pass < 8; ++pass)
        for (uint32_t v = 0; v < shell.view.vertex_count(); ++v) {
            const auto at = interior_ends(shell.view, v);
            Ends ends;
            for (size_t i = 0; i < at.size() && i < kMostArms; ++i) ends.add(at[i]);
            cut_ends(shell.view, v, ends, touched);
            touched.clear();
        }
    EXPECT_EQ(component_count(shell.view), shell.view.element_count());
    EXPECT_EQ(live_vertex_count(shell.view), 3 * shell.view.element_count());
    EXPECT_EQ(broken_rule(shell), "");
}

}  // namespace
}  // namespace cullet
