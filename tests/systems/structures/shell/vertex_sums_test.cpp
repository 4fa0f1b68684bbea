// Sums of a shell's vertices that are kept block by block, and what a hit asks of them.
#include "systems/structures/shell/vertex_sums.hpp"
#include "components/state.hpp"

#include <gtest/gtest.h>

#include "engine/random.hpp"
#include "systems/structures/shell/cook/apply_pins.hpp"
#include "systems/structures/shell/flood_parts.hpp"
#include "systems/structures/shell/rest_of_body.hpp"
#include "systems/structures/shell/struck_normal.hpp"
#include "tests/support/hand_off.hpp"
#include "tests/support/sample_shells.hpp"

namespace cullet {
namespace {

struct Vase {
    State state;
    Row<Structures> row;

    Vase() : row(build_shell(state, sample_vase(0.3, 0.005, 48, 40).source(), sample_material(state)).value()) {}
    ShellView view() { return ShellView(state, row); }
    Vec3 place_of(uint32_t v) { return state.vertices.rest[view().vertex(v)]; }
};

void expect_same(const VertexSums& a, const VertexSums& b) {
    EXPECT_EQ(a.mass, b.mass);
    EXPECT_EQ(a.first, b.first);
    EXPECT_EQ(a.second.xx, b.second.xx);
    EXPECT_EQ(a.second.yz, b.second.yz);
    EXPECT_EQ(a.pinned, b.pinned);
    EXPECT_EQ(a.low, b.low);
    EXPECT_EQ(a.high, b.high);
}

TEST(VertexSums, KeptOnesAreThoseOfALookAtAllVertices) {
    Vase vase;
    const ShellView shell = vase.view();
    apply_pins(shell, {-1, -1, -1}, {1, 0.01f, 1});
    const VertexSums anew = vertex_sums(shell);
    EXPECT_GT(anew.pinned, 0u);
    keep_vertex_sums(shell);
    EXPECT_TRUE(keeps_vertex_sums(shell));
    expect_same(vertex_sums(shell), anew);
    measure_outdated(shell);
    expect_same(vertex_sums(shell), anew);  // now from what was kept
    double mass = 0;
    Vec3d first;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        mass += vase.state.vertices.mass[shell.vertex(v)];
        first += vase.state.vertices.mass[shell.vertex(v)] * Vec3d(vase.place_of(v));
    }
    EXPECT_NEAR(anew.mass, mass, 1e-12 * mass);
    EXPECT_NEAR(length(anew.first - first), 0, 1e-12 * mass);
}

TEST(VertexSums, ABlockThatIsOutdatedIsMeasuredAnew) {
    Vase vase;
    const ShellView shell = vase.view();
    keep_vertex_sums(shell);
    measure_outdated(shell);
    const VertexSums before = vertex_sums(shell);
    const uint32_t v = shell.vertex_count() / 2;
    const double mass = vase.state.vertices.mass[shell.vertex(v)];
    vase.state.vertices.mass[shell.vertex(v)] = 2 * mass;
    outdate_block(shell, v);
    EXPECT_NEAR(vertex_sums(shell).mass, before.mass + mass, 1e-12 * before.mass);
    measure_outdated(shell);
    EXPECT_NEAR(vertex_sums(shell).mass, before.mass + mass, 1e-12 * before.mass);
}

TEST(VertexSums, AShellOfRowsThatWereTakenAgainKeepsNone) {
    Vase vase;
    keep_vertex_sums(vase.view());
    measure_outdated(vase.view());
    const Range rows = vase.view().vertices();
    release_shell(vase.state, vase.row);
    ShellRoom room;
    room.vertices = rows.capacity, room.elements = 8;
    const Row<Structures> other = make_shell(vase.state, room);
    ASSERT_TRUE(other.exists());
    ShellView view(vase.state, other);
    EXPECT_EQ(view.vertices().first, rows.first);
    view.vertices().count = 1;
    EXPECT_FALSE(keeps_vertex_sums(view));
}

TEST(VertexSums, TheNearestVertexAndTheStruckNormalAreThoseOfALookAtAll) {
    Vase plain, kept;
    keep_vertex_sums(kept.view());
    measure_outdated(kept.view());
    const Random random{5};
    for (uint32_t i = 0; i < 500; ++i) {
        const auto at = [&](uint32_t k) { return static_cast<float>(random.uniform(i, k)) - 0.5f; };
        Vec3 place = 0.6f * Vec3{at(0), at(1), at(2)};
        if (i % 3 == 0) {  // half-way between two vertices: a tie, or nearly
            const uint32_t v = (i * 7919) % (plain.view().vertex_count() - 1);
            place = 0.5f * (plain.place_of(v) + plain.place_of(v + 1));
        }
        ASSERT_EQ(nearest_vertex(kept.view(), place), nearest_vertex(plain.view(), place));
        const Vec3 normal = normalised(Vec3{at(3), at(4), at(5)});
        ASSERT_EQ(struck_normal(kept.view(), place, normal, 0.03f), struck_normal(plain.view(), place, normal, 0.03f));
    }
}

/// A vase of which a piece came off in a run that moved some blocks; the others move as the rest does.
struct HalfMoved : Vase {
    std::vector<FragmentPart> parts{kMostParts};
    RestMotion rest{{0.01, 0.1, -0.02}, {0.5, -5, 0.25}, {1, 2, -3}};
    HandoffStart start{rest.velocity, rest.spin, rest.centre, 5};
    std::optional<RestMotion> known_rest;

    HalfMoved() {
        row = cut_by_label(state, row, [&](uint32_t e) {
            return element_middle(view(), e).y > 0.2 && element_middle(view(), e).x > 0.03 ? 1 : 0;
        });
        const ShellView shell = view();
        for (uint32_t e = 0; e < shell.element_count(); ++e) state.elements.part[shell.element(e)] = 0;
        parts.resize(find_pieces(shell, parts));
        keep_vertex_sums(shell);
        const Random random{3};
        for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
            const uint32_t block = v / kVerticesPerBlock;
            const bool moves = block % 3 == 0;
            state.vertex_blocks.moves[block_row(shell, block)] = moves;
            Vec3d u = rest.at(place_of(v));
            if (moves) u += Vec3d(random.uniform(v, 0), random.uniform(v, 1), random.uniform(v, 2));
            state.vertices.velocity.set(shell.vertex(v), u.to_float());
        }
    }
    std::vector<PartMotion> hand_off() {
        std::vector<PartMotion> motions;
        test::hand_off(view(), start, parts, motions, known_rest);
        return motions;
    }
};

TEST(VertexSums, WhatMovesWithTheRestNeedsNoVelocitiesOfItsOwn) {
    HalfMoved vase;
    ASSERT_EQ(vase.parts.size(), 2u);
    const std::vector<PartMotion> written = vase.hand_off();
    const ShellView shell = vase.view();
    for (uint32_t v = 0; v < shell.vertex_count(); ++v)
        if (!vase.state.vertex_blocks.moves[block_row(shell, v / kVerticesPerBlock)])
            vase.state.vertices.velocity.set(shell.vertex(v), {});
    vase.known_rest = vase.rest;
    const std::vector<PartMotion> known = vase.hand_off();
    for (size_t p = 0; p < known.size(); ++p) {
        EXPECT_NEAR(known[p].mass, written[p].mass, 1e-9 * written[p].mass);
        EXPECT_NEAR(length(known[p].centre - written[p].centre), 0, 1e-9);
        EXPECT_NEAR(length(known[p].velocity - written[p].velocity), 0, 1e-6 * length(written[p].velocity));
        EXPECT_NEAR(length(known[p].spin - written[p].spin), 0, 1e-5 * length(written[p].spin));
        EXPECT_NEAR(known[p].hidden_energy, written[p].hidden_energy, 1e-6 * written[p].hidden_energy);
        EXPECT_NEAR(known[p].radius, written[p].radius, 1e-6);
    }
}

TEST(VertexSums, WhatWasWrittenIsClearedWhereABlockMoved) {
    HalfMoved vase;
    const ShellView shell = vase.view();
    stop_blocks(shell);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const Vec3 velocity = vase.state.vertices.velocity[shell.vertex(v)];
        EXPECT_EQ(velocity == Vec3{}, (v / kVerticesPerBlock) % 3 == 0) << v;
        EXPECT_EQ(vase.state.vertex_blocks.moves[block_row(shell, v / kVerticesPerBlock)], 0);
    }
}

}  // namespace
}  // namespace cullet
