// Springs of a shell that was cut or re-meshed, beside those that it would be given.
#include "systems/models/thick_shell/springs/rebuild_springs.hpp"
#include "components/state.hpp"

#include <gtest/gtest.h>

#include <map>

#include "engine/random.hpp"
#include "systems/models/thick_shell/springs/check_springs.hpp"
#include "systems/models/thick_shell/springs/edge_stiffness.hpp"
#include "systems/models/thick_shell/springs/spring_loop.hpp"
#include "systems/models/thick_shell/stiffness/refresh.hpp"
#include "systems/structures/shell/insert_vertex.hpp"
#include "tests/support/spring_strip.hpp"

namespace cullet::test {
namespace {

/// Elements whose middle lies above y lose their links to those below; every vertex on the line gets a copy for them.
std::vector<uint32_t> cut_above(SpringBench& bench, double y) {
    const ShellView shell = bench.view().shell;
    State& s = bench.state();
    const auto is_above = [&](uint32_t e) {
        double sum = 0;
        for (const uint32_t v : s.elements.corner[shell.element(e)]) sum += double{s.vertices.rest[shell.vertex(v)].y};
        return sum / 3 > y;
    };
    std::map<uint32_t, uint32_t> copies;
    std::vector<uint32_t> touched;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (uint32_t k = 0; k < 3; ++k) {
            uint32_t& other = s.elements.neighbour[shell.element(e)][k];
            if (other == kNone || is_above(other) == is_above(e)) continue;
            const auto& corner = s.elements.corner[shell.element(e)];
            for (const uint32_t v : {corner[k], corner[(k + 1) % 3]}) copies.try_emplace(v, kNone);
            other = kNone;
        }
    for (auto& [v, copy] : copies) {
        copy = shell.vertices().count++;
        s.vertices.copy_rows(s.vertices, shell.vertex(v), shell.vertex(copy), 1);
        touched.push_back(v), touched.push_back(copy);
    }
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (uint32_t& v : s.elements.corner[shell.element(e)]) {
            if (is_above(e) && copies.contains(v)) v = copies[v];
            s.vertices.element[shell.vertex(v)] = e;
        }
    return touched;
}

TEST(RebuildSprings, CutEdgesShareTheirStiffnessAndKeepTheirLengths) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench bench = make_strip(layout, 64);
        State& state = bench.state();
        const SpringView view = bench.view();
        const uint32_t before = view.spring_count();
        double stiffness = 0, mass = 0;
        for (uint32_t s = 0; s < before; ++s) stiffness += state.springs.stiffness[view.spring(s)];
        for (uint32_t v = 0; v < bench.size(); ++v) mass += state.vertices.mass[view.shell.vertex(v)];
        const std::vector<uint32_t> touched = cut_above(bench, 3 * kEdge * std::sqrt(0.75));
        ASSERT_TRUE(rebuild_springs(view, touched));
        EXPECT_EQ(view.spring_count(), before + touched.size() / 2 - 1);
        double after = 0, mass_after = 0;
        for (uint32_t s = 0; s < view.spring_count(); ++s) {
            after += state.springs.stiffness[view.spring(s)];
            EXPECT_NEAR(state.springs.rest_length[view.spring(s)], kEdge, 1e-8);
        }
        for (uint32_t v = 0; v < bench.size(); ++v) mass_after += state.vertices.mass[view.shell.vertex(v)];
        EXPECT_NEAR(after, stiffness, 1e-5 * stiffness);
        EXPECT_NEAR(mass_after, mass, 1e-14 * mass);
        const auto sound = check_springs(state, "cut", "");
        EXPECT_TRUE(sound.ok()) << (sound.ok() ? "" : sound.error());
    }
}

TEST(RebuildSprings, AreThoseThatTheCutShellWouldBeGiven) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench bench = make_strip(layout, 64);
        State& state = bench.state();
        const SpringView view = bench.view();
        ASSERT_TRUE(rebuild_springs(view, cut_above(bench, 3 * kEdge * std::sqrt(0.75))));
        // A copy of the shell without springs is given new ones, and put where the other is.
        const Row<Structures> copy = copy_shell(state, bench.shell(), room_of(state, bench.shell()));
        SpringSettings settings = settings_of(layout);
        settings.time_step = state.shell_springs.time_step[bench.springs()];
        const auto given = give_springs(state, copy, settings);
        ASSERT_TRUE(given.ok()) << given.error();
        const SpringView fresh(state, given.value());
        start_springs(fresh, {});
        start_springs(view, {});
        for (uint32_t v = 0; v < bench.size(); v += 5) {
            const Vec3 kick{0.01f, -0.02f, 0.03f * static_cast<float>(v % 7)};
            state.vertices.velocity.set(view.shell.vertex(v), kick);
            state.vertices.velocity.set(fresh.shell.vertex(v), kick);
        }
        run_springs(state, bench.springs(), 50);
        run_springs(state, given.value(), 50);
        for (uint32_t v = 0; v < bench.size(); ++v) {
            EXPECT_LT(length(view.position(v) - fresh.position(v)), 2e-7f);
            if (view.has_layers()) {
                EXPECT_LT(length(view.twin_position(v) - fresh.twin_position(v)), 2e-7f);
            }
        }
    }
}

TEST(RebuildSprings, InMotionKeepsMomentumAndEveryPointsPlace) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench bench = make_strip(layout, 64);
        bench.set_velocity(3, {0.3f, -0.2f, 0.5f});
        bench.set_velocity(40, {-0.3f, 0.2f, 0.5f});
        for (int i = 0; i < 33; ++i) bench.step();
        const SpringView view = bench.view();
        const SpringMotion before = motion_of(view);
        const double energy = spring_energy(view);
        ASSERT_TRUE(rebuild_springs(view, cut_above(bench, 3 * kEdge * std::sqrt(0.75))));
        const SpringMotion cut = motion_of(view);
        EXPECT_LT(length(cut.momentum - before.momentum), 1e-9 * before.mass);
        EXPECT_NEAR(cut.kinetic, before.kinetic, 1e-6 * before.kinetic);
        EXPECT_NEAR(spring_energy(view), energy, 1e-4 * energy) << "the same springs in two halves";
        for (int i = 0; i < 100; ++i) bench.step();
        const SpringMotion after = motion_of(view);
        EXPECT_LT(length(after.momentum - before.momentum), 1e-6 * before.mass);
        EXPECT_LT(length(after.angular - before.angular), 1e-6 * before.mass * 0.1);
    }
}

TEST(RebuildSprings, RebuildingAllGivesWhatRebuildingTheTouchedGives) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench few = make_strip(layout, 64), all = make_strip(layout, 64);
        const double line = 3 * kEdge * std::sqrt(0.75);
        ASSERT_TRUE(rebuild_springs(few.view(), cut_above(few, line)));
        std::vector<uint32_t> touched = cut_above(all, line);
        touched.resize(1000, touched[0]);  // more than are listed
        ASSERT_TRUE(rebuild_springs(all.view(), touched));
        few.set_velocity(5, {1, 0, 0}), all.set_velocity(5, {1, 0, 0});
        for (int i = 0; i < 20; ++i) few.step(), all.step();
        for (uint32_t v = 0; v < few.size(); ++v) EXPECT_EQ(few.view().position(v), all.view().position(v));
    }
}

/// A ball of uneven depth whose inward directions lean, so that the two diagonals of its side quads differ.
SpringBench make_uneven(SpringLayout layout) {
    SpringBench bench(bench_sphere(0.1, 2), 0.006, {}, settings_of(layout), {}, 32);
    State& state = bench.state();
    release_springs(state, bench.shell());
    const Random random{17};
    const ShellView shell(state, bench.shell());
    for (uint32_t v = 0; v < bench.size(); ++v) {
        const uint32_t row = shell.vertex(v);
        const auto r = [&](uint64_t k) { return static_cast<float>(random.uniform(v, k)); };
        state.vertices.depth[row] *= 0.6f + 0.8f * r(0);
        const Vec3 lean{0.4f * r(1) - 0.2f, 0.4f * r(2) - 0.2f, 0.4f * r(3) - 0.2f};
        state.vertices.inward.set(row, normalised(state.vertices.inward[row] + lean));
    }
    EXPECT_EQ(give_springs(state, bench.shell(), settings_of(layout)).value(), bench.springs());
    start_springs(bench.view(), {});
    return bench;
}

/// Puts `count` vertices into the shell, some beside others, and what the springs must know of them; not rebuilt.
std::vector<uint32_t> insert_vertices(SpringBench& bench, uint32_t count) {
    const SpringView view = bench.view();
    const Elements& elements = bench.state().elements;
    Touched touched(kStiffnessRepair);
    const uint32_t before = view.shell.element_count();
    for (uint32_t i = 0, e = 3; i < count; e = (e + 7) % before) {
        const uint32_t k = e % 3, row = view.shell.element(e), other = elements.neighbour[row][k];
        const float tau = 0.3f + 0.05f * static_cast<float>(i % 8);
        bool is_full = false;
        if (!can_insert(view.shell, e, k, tau, is_full)) continue;
        const uint32_t p = elements.corner[row][k], q = elements.corner[row][(k + 1) % 3];
        const uint32_t w = insert_vertex(view.shell, e, k, tau, touched);
        forget_springs(view, e);
        if (other != kNone) forget_springs(view, other);
        if (view.has_layers()) insert_twin(view, p, q, w, tau);
        ++i;
    }
    return {touched.weighed.vertex, touched.weighed.vertex + touched.weighed.count};
}

/// Lengths at rest and stiffness of the live springs by their ends, as seen from the lower one: outer and inner skin,
/// middle, cross springs.
std::map<std::pair<uint32_t, uint32_t>, std::array<float, 9>> springs_of(const SpringView& view) {
    std::map<std::pair<uint32_t, uint32_t>, std::array<float, 9>> seen;
    const Springs& springs = view.state.springs;
    const LayerSprings& layers = view.state.layer_springs;
    for (uint32_t s = 0; s < view.spring_count(); ++s) {
        const uint32_t row = view.spring(s), a = springs.a[row], b = springs.b[row];
        if (a == kNone) continue;
        std::array<float, 9> one{springs.rest_length[row], springs.stiffness[row]};
        if (view.has_layers()) {
            const uint32_t l = view.layer(s);
            const auto cross = layers.cross_length[l];
            one = {one[0],
                   one[1],
                   layers.inner_length[l],
                   layers.inner_stiffness[l],
                   layers.mid_length[l],
                   layers.mid_stiffness[l],
                   layers.cross_stiffness[l],
                   cross[a < b ? 0 : 1],
                   cross[a < b ? 1 : 0]};
        }
        EXPECT_TRUE(seen.try_emplace(std::minmax(a, b), one).second) << "two springs join " << a << " and " << b;
    }
    return seen;
}

TEST(RebuildSprings, AfterInsertsAreThoseThatTheShellWouldBeGiven) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench bench = make_uneven(layout);
        State& state = bench.state();
        ASSERT_TRUE(rebuild_springs(bench.view(), insert_vertices(bench, 12)));
        const auto sound = check_springs(state, "re-meshed", "");
        EXPECT_TRUE(sound.ok()) << (sound.ok() ? "" : sound.error());
        const Row<Structures> copy = copy_shell(state, bench.shell(), room_of(state, bench.shell()));
        const auto given = give_springs(state, copy, settings_of(layout));
        ASSERT_TRUE(given.ok()) << given.error();
        const SpringView view = bench.view(), fresh(state, given.value());
        const auto ours = springs_of(view), theirs = springs_of(fresh);
        EXPECT_EQ(ours.size(), theirs.size());
        for (const auto& [ends, wanted] : theirs) {
            ASSERT_TRUE(ours.contains(ends)) << ends.first << " and " << ends.second;
            const std::array<float, 9>& found = ours.at(ends);
            for (size_t i = 0; i < 9; ++i) EXPECT_NEAR(found[i], wanted[i], 1e-5f * wanted[i]) << i;
        }
        for (uint32_t v = 0; v < bench.size() && view.has_layers(); ++v) {
            const uint32_t a = view.twin(v), b = fresh.twin(v);
            for (const Column<float>* column : {&state.twins.mass_share, &state.twins.inverse_mass,
                                                &state.twins.inverse_rest, &state.twins.stiffness_rest})
                EXPECT_NEAR((*column)[a], (*column)[b], 1e-5f * (*column)[b]) << v;
        }
    }
}

TEST(RebuildSprings, AfterInsertsAShellAtRestStaysAtRest) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench bench = make_uneven(layout);
        ASSERT_TRUE(rebuild_springs(bench.view(), insert_vertices(bench, 12)));
        for (int i = 0; i < 20; ++i) bench.step();
        const double sound = std::sqrt(kYoung / 1000);
        for (uint32_t v = 0; v < bench.size(); ++v) {
            EXPECT_LT(length(bench.velocity(v)), 1e-4 * sound) << v;
            if (bench.view().has_layers()) {
                EXPECT_LT(length(bench.state().twins.velocity[bench.view().twin(v)]), 1e-4 * sound) << v;
            }
        }
    }
}

TEST(RebuildSprings, InsertsInMotionKeepMassCentreAndMomentumOfBothLayers) {
    for (const SpringLayout layout : kLayouts) {
        SpringBench bench = make_uneven(layout);
        for (uint32_t v = 0; v < bench.size(); v += 3)
            bench.set_velocity(v, {0.1f * static_cast<float>(v % 5), -0.2f, 0.05f * static_cast<float>(v % 7)});
        for (int i = 0; i < 10; ++i) bench.step();
        const SpringMotion before = motion_of(bench.view());
        ASSERT_TRUE(rebuild_springs(bench.view(), insert_vertices(bench, 12)));
        const SpringMotion after = motion_of(bench.view());
        EXPECT_NEAR(after.mass, before.mass, 1e-12 * before.mass);
        EXPECT_LT(length(after.centre - before.centre), 1e-8);
        EXPECT_LT(length(after.momentum - before.momentum), 1e-7 * before.mass);
        EXPECT_LE(after.kinetic, before.kinetic * (1 + 1e-7));
        const SpringMotion start = motion_of(bench.view());
        for (int i = 0; i < 100; ++i) bench.step();
        EXPECT_LT(length(motion_of(bench.view()).momentum - start.momentum), 1e-6 * before.mass);
        EXPECT_EQ(bench.state().validate(), "");
    }
}

TEST(RebuildSprings, SpringsOfNewEdgesHaveFlowedAsThoseThatTheyReplace) {
    for (const SpringLayout layout : kLayouts)
        for (const bool keeps : {false, true}) {
            SpringBench bench = make_uneven(layout);
            const SpringView view = bench.view();
            State& state = bench.state();
            if (keeps) state.shell_springs.keeps_lengths[view.row] |= kKeepsLengths;
            for (uint32_t s = 0; s < view.spring_count(); ++s) {
                const uint32_t row = view.spring(s);
                state.springs.plastic_length[row] = 1.1f * state.springs.rest_length[row];
                if (view.has_layers())
                    state.layer_springs.inner_plastic[view.layer(s)] =
                        0.9f * state.layer_springs.inner_length[view.layer(s)];
            }
            const uint32_t before = view.spring_count();
            ASSERT_TRUE(rebuild_springs(view, insert_vertices(bench, 12)));
            ASSERT_GT(view.spring_count(), before);
            for (uint32_t s = 0; s < view.spring_count(); ++s) {
                const uint32_t row = view.spring(s), a = state.springs.a[row], b = state.springs.b[row];
                if (a == kNone) continue;
                EXPECT_NEAR(state.springs.plastic_length[row] / state.springs.rest_length[row], 1.1f, 1e-5f);
                if (view.has_layers()) {
                    const uint32_t layer = view.layer(s);
                    EXPECT_NEAR(state.layer_springs.inner_plastic[layer] / state.layer_springs.inner_length[layer],
                                0.9f, 1e-5f);
                }
                if (s < before) continue;
                // Where the shape at rest is the one that the shell has now, nothing pulls in it.
                const auto shape = static_cast<float>(length(outer_rest(view, b) - outer_rest(view, a)));
                EXPECT_NEAR((keeps ? state.springs.plastic_length : state.springs.rest_length)[row], shape,
                            1e-5f * shape);
            }
        }
}

TEST(RebuildSprings, WithoutRoomNothingChanges) {
    SpringBench bench = make_strip(SpringLayout::OneLayer, 64);
    State& state = bench.state();
    const std::vector<uint32_t> touched = cut_above(bench, 3 * kEdge * std::sqrt(0.75));
    state.shell_springs.springs[bench.springs()].capacity = state.shell_springs.springs[bench.springs()].count + 3;
    const uint64_t before = state.springs.hash(state.spring_slots.hash(0));
    EXPECT_FALSE(rebuild_springs(bench.view(), touched));
    EXPECT_EQ(state.springs.hash(state.spring_slots.hash(0)), before);
}

}  // namespace
}  // namespace cullet::test
