// What happens to a broken shell inside of a frame does not allocate.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

#include "components/state.hpp"
#include "cullet/material.hpp"
#include "sample_game/allocations.hpp"
#include "sample_game/meshes.hpp"
#include "systems/structures/shell/draw_shell.hpp"
#include "systems/structures/shell/make_piece.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/rigid_handoff.hpp"
#include "tests/support/sample_shells.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet {
namespace {

TEST(Pieces, GroupingHandOffPiecesHullsAndDrawingDoNotAllocate) {
    State state;
    const auto built = build_shell(state, sample_vase(0.3, 0.005, 48, 40).source(), sample_material(state));
    ASSERT_TRUE(built.ok()) << built.error();
    const Row<Structures> row =
        cut_by_label(state, built.value(), nearest_seed(ShellView(state, built.value()), 15, 1));
    const ShellView shell(state, row);
    std::vector<FragmentPart> parts(100);
    Fragments fragments(100);
    Touches touches(1);
    Range vertices{state.view_vertices.append(200000), 0, 200000},
        indices{state.view_indices.append(200000), 0, 200000};
    start_counting_allocations();
    const uint32_t count = group_fragments(shell, parts);
    const std::span<const FragmentPart> found(parts.data(), count);
    rigid_handoff(shell, {{}, {}, {}, 5}, found, fragments, touches);
    for (const FragmentPart& part : found) {
        const Row<Structures> piece = make_piece(state, row, part, 1);
        draw_shell(ShellView(state, piece), {state.view_vertices, state.view_indices}, vertices, indices);
        mass_properties(shell_moments(ShellView(state, piece)));
        release_shell(state, piece);
    }
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
    EXPECT_GT(count, 5u);
}

/// A vase of a kind of fracture, struck by a ball; `look` after each step.
template <class Look>
void break_vase(FractureKind fracture, Look look) {
    MaterialTable table;
    MaterialSettings concrete = table.find("concrete").value();
    concrete.fracture = fracture;
    ASSERT_TRUE(table.change(concrete).ok());
    CookSettings cooking;
    cooking.material = "concrete", cooking.materials = &table, cooking.thickness = 0.005f, cooking.longest_edge = 100;
    cooking.thick_shell.measures_threshold = false;
    const Result<Model> model = cook(test::view_of_mesh(make_vase(0.3f, 0.0125f)), cooking);
    ASSERT_TRUE(model.ok()) << model.error();
    World world = test::make_world(test::small_settings());
    ASSERT_TRUE(world.spawn(world.add_model(*model).value()).ok());
    ASSERT_TRUE(world.add_sphere(test::ball_at({0.01f, 0.13f, 0}, 0.3f, 8)).ok());
    look(world);
    for (int frame = 0; frame < 12; ++frame) world.step(), look(world);
    EXPECT_GT(world.contents().data.counts.broke, 0u);
}

// A page that is first touched within a frame costs more than what is done with it. Finer kinds take larger copies.
TEST(Pieces, PagesForAHitAndItsPiecesAreThereFromTheSpawnOn) {
    constexpr int kTables = 6;
    const auto tables_of = [](State& state) {
        return std::array<AnyTable*, kTables>{&state.vertices,        &state.elements,         &state.hinges,
                                              &state.stiffness_packs, &state.stiffness_blocks, &state.stiffness_links};
    };
    for (const FractureKind fracture : {FractureKind::Large, FractureKind::Coarse, FractureKind::Fine}) {
        SCOPED_TRACE(name_of(fracture));
        std::array<uint32_t, kTables> most{};
        bool is_broken = false;
        break_vase(fracture, [&](World& world) {
            const auto tables = tables_of(test::state_of(world));
            for (int t = 0; t < kTables && !is_broken; ++t) most[t] = std::max(most[t], tables[t]->size());
            is_broken = world.contents().data.counts.broke > 0;  // from then on quiet frames make room for further hits
        });
        bool is_first = true;
        break_vase(fracture, [&](World& world) {
            if (!std::exchange(is_first, false)) return;
            const auto tables = tables_of(test::state_of(world));
            for (int t = 0; t < kTables; ++t) {
                EXPECT_GT(most[t], tables[t]->size()) << tables[t]->name();
                EXPECT_EQ(tables[t]->commit_rows(most[t]), 0u) << tables[t]->name() << " had fewer than " << most[t];
            }
        });
    }
}

TEST(Pieces, TwoRunsGiveTheSameBytes) {
    const auto run = [](State& state) {
        const auto built = build_shell(state, sample_sphere(0.2, 0.01, 4).source(), sample_material(state));
        const Row<Structures> row =
            cut_by_label(state, built.value(), nearest_seed(ShellView(state, built.value()), 15, 1));
        std::vector<FragmentPart> parts(100);
        parts.resize(group_fragments(ShellView(state, row), parts));
        for (const FragmentPart& part : parts) make_piece(state, row, part, 1);
    };
    State a, b;
    run(a), run(b);
    EXPECT_EQ(a.first_difference(b), "");
}

}  // namespace
}  // namespace cullet
