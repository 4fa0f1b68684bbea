// Springs from elements, and as rows: given, copied, refused, given back.
#include "systems/models/thick_shell/springs/give_springs.hpp"
#include "components/state.hpp"

#include <gtest/gtest.h>

#include "systems/models/thick_shell/springs/check_springs.hpp"
#include "systems/models/thick_shell/springs/spring_loop.hpp"
#include "tests/support/spring_strip.hpp"

namespace cullet::test {
namespace {

uint64_t hash_of_pools(const State& state) {
    uint64_t hash = 0;
    state.for_each_pool([&](const RangePool& pool) { hash = pool.hash(hash); });
    return hash;
}

TEST(GiveSprings, FollowsTheAreaRuleInsideAndAtBorders) {
    SpringBench bench = make_strip(SpringLayout::OneLayer);
    const SpringView view = bench.view();
    const double inside = std::sqrt(3.0) / 2 * kYoung * kDepth;
    uint32_t at_border = 0;
    EXPECT_EQ(view.spring_count(), bench.size() + view.shell.element_count() - 1) << "Euler's formula of a disc";
    for (uint32_t s = 0; s < view.spring_count(); ++s) {
        const uint32_t row = view.spring(s), e = bench.state().springs.element[row];
        uint32_t triangles = 1;
        for (uint32_t k = 0; k < 3; ++k)
            if (bench.state().element_springs.spring[view.edges(e)][k] == s)
                triangles += bench.state().elements.neighbour[view.shell.element(e)][k] != kNone;
        at_border += triangles == 1;
        EXPECT_NEAR(bench.state().springs.stiffness[row], inside * triangles / 2, 2e-5 * inside);
        EXPECT_NEAR(bench.state().springs.rest_length[row], kEdge, 1e-8);
    }
    EXPECT_EQ(at_border, 2u * 12 + 2 * 6);
}

TEST(GiveSprings, SharesMassesAsB1Says) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench bench = make_strip(layout);
        const SpringView view = bench.view();
        double elements = 0, points = 0;
        for (uint32_t e = 0; e < view.shell.element_count(); ++e)
            elements += bench.state().elements.mass[view.shell.element(e)];
        for (uint32_t v = 0; v < bench.size(); ++v) {
            const double mass = bench.state().vertices.mass[view.shell.vertex(v)];
            points += mass;
            if (!view.has_layers()) continue;
            EXPECT_FLOAT_EQ(bench.state().twins.mass_share[view.twin(v)], static_cast<float>(mass / 2));
            EXPECT_FLOAT_EQ(bench.state().twins.inverse_mass[view.twin(v)], static_cast<float>(2 / mass));
        }
        EXPECT_NEAR(points, elements, 1e-14 * elements);
    }
}

TEST(GiveSprings, ASandwichCarriesTheStiffnessOfOneLayerInSkinsAndMiddle) {
    SpringSettings settings = settings_of(SpringLayout::Sandwich);
    settings.length_factor = 2;
    SpringBench bench(bench_strip(6, 6, kEdge), kDepth, {}, settings);
    const SpringView view = bench.view();
    const double whole = std::sqrt(3.0) / 2 * kYoung * kDepth;
    for (uint32_t s = 0; s < view.spring_count(); ++s) {
        const double outer = bench.state().springs.stiffness[view.spring(s)];
        const LayerSprings& layers = bench.state().layer_springs;
        const double inner = layers.inner_stiffness[view.layer(s)], middle = layers.mid_stiffness[view.layer(s)];
        EXPECT_NEAR(outer, inner, 1e-4 * outer);
        EXPECT_NEAR(outer / (outer + inner + middle), 1 / (3 * 4.0) / 2, 1e-4);
        const double part = (outer + inner + middle) / whole;
        EXPECT_TRUE(std::fabs(part - 1) < 1e-4 || std::fabs(part - 0.5) < 1e-4) << part;
        EXPECT_GT(layers.cross_stiffness[view.layer(s)], 0);
    }
}

TEST(GiveSprings, ATooDeepOrTooThinShellHasAGammaWithinItsBounds) {
    for (const auto& [depth, gamma] : {std::pair{0.004, 2.5}, {0.1, 0.57735}, {1e-4, 5.0}}) {
        SpringBench bench(bench_strip(4, 4, kEdge), depth, {}, settings_of(SpringLayout::Sandwich));
        EXPECT_NEAR(bench.state().shell_springs.length_factor[bench.springs()], gamma, 1e-4 * gamma);
    }
}

TEST(GiveSprings, RefusesWhatIsOutOfRangeWithASentence) {
    SpringBench bench = make_strip(SpringLayout::OneLayer);
    State& state = bench.state();
    const auto given = give_springs(state, bench.shell(), SpringSettings{});
    ASSERT_FALSE(given.ok());
    EXPECT_NE(given.error().find("has springs already"), std::string::npos);
    release_springs(state, bench.shell());
    const auto refused = [&](auto change, const char* what) {
        SpringSettings settings;
        change(settings);
        const auto result = give_springs(state, bench.shell(), settings);
        ASSERT_FALSE(result.ok());
        EXPECT_NE(result.error().find(what), std::string::npos) << result.error();
    };
    refused([](SpringSettings& s) { s.damping_ratio = 0.31f; }, "damping_ratio");
    refused([](SpringSettings& s) { s.young_modulus = -1; }, "young_modulus");
    refused([](SpringSettings& s) { s.young_modulus = std::nanf(""); }, "young_modulus");
    refused([](SpringSettings& s) { s.length_factor = 0.3f; }, "length_factor");
    refused([](SpringSettings& s) { s.volume_energy = 1e9f; }, "volume_energy");
    refused([](SpringSettings& s) { s.time_step = -1; }, "time_step");
    const std::vector<GivenSpring> wild[] = {{{0, 0, 1, 1}},     {{0, 99999, 1, 1}},   {{0, 1, -1, 1}},
                                             {{0, 1, 1, 1e30f}}, {{0, 1, 1, 1.1e12f}}, {{0, 1, 1.1e6f, 1}}};
    for (const auto& springs : wild) EXPECT_FALSE(give_springs(state, bench.shell(), springs, {}).ok());
    EXPECT_FALSE(springs_of(state, bench.shell()).exists());
    EXPECT_TRUE(give_springs(state, bench.shell(), SpringSettings{}).ok());
}

TEST(GiveSprings, ReleasedRowsAreAllBack) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench bench = make_strip(layout);
        State& state = bench.state();
        release_springs(state, bench.shell());
        const uint64_t without = hash_of_pools(state);
        ASSERT_TRUE(give_springs(state, bench.shell(), settings_of(layout)).ok());
        EXPECT_NE(hash_of_pools(state), without);
        ShellRoom room = room_of(state, bench.shell());
        room.with_springs = true;
        const Row<Structures> copy = copy_shell(state, bench.shell(), room);
        ASSERT_TRUE(copy.exists());
        ASSERT_TRUE(springs_of(state, copy).exists());
        release_shell(state, copy);
        release_springs(state, bench.shell());
        EXPECT_EQ(hash_of_pools(state), without);
    }
}

TEST(GiveSprings, ACopyMovesAsItsSourceDoes) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench bench = make_strip(layout);
        State& state = bench.state();
        bench.set_velocity(7, {0.1f, 0.2f, 0.3f});
        for (int i = 0; i < 7; ++i) bench.step();
        ShellRoom room = room_of(state, bench.shell());
        room.vertices += 100;
        room.with_springs = true;
        const Row<Structures> copy = copy_shell(state, bench.shell(), room);
        ASSERT_TRUE(copy.exists());
        const Row<ShellSprings> row = springs_of(state, copy);
        run_springs(state, row, 30);
        run_springs(state, bench.springs(), 30);
        const SpringView a = bench.view(), b(state, row);
        for (uint32_t v = 0; v < bench.size(); ++v) {
            EXPECT_EQ(a.position(v), b.position(v));
            if (a.has_layers()) {
                EXPECT_EQ(a.twin_position(v), b.twin_position(v));
            }
        }
        EXPECT_TRUE(check_springs(state, "copy", "").ok());
    }
}

TEST(GiveSprings, ACopyOfSpringsGivenByHandOnAShellWithElementsIsSound) {
    SpringBench bench = make_strip(SpringLayout::OneLayer);
    State& state = bench.state();
    release_springs(state, bench.shell());
    const std::vector<GivenSpring> given{{0, 1, 0.01f, 100}, {1, 20, 0.05f, 50}};
    ASSERT_TRUE(give_springs(state, bench.shell(), given, {}).ok());
    ASSERT_TRUE(check_springs(state, "source", "").ok());
    ShellRoom room = room_of(state, bench.shell());
    room.with_springs = true;
    const Row<Structures> copy = copy_shell(state, bench.shell(), room);
    ASSERT_TRUE(copy.exists());
    const auto sound = check_springs(state, "copy", "");
    EXPECT_TRUE(sound.ok()) << (sound.ok() ? "" : sound.error());
    EXPECT_EQ(SpringView(state, springs_of(state, copy)).spring_count(), 2u);
}

}  // namespace
}  // namespace cullet::test
