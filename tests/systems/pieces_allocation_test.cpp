// What happens to a broken shell inside of a frame does not allocate.
#include <gtest/gtest.h>

#include "sample_game/allocations.hpp"
#include "systems/fragments/make_piece.hpp"
#include "systems/fragments/mass_properties.hpp"
#include "systems/fragments/rigid_handoff.hpp"
#include "systems/view/draw_shell.hpp"
#include "tests/support/sample_shells.hpp"

namespace cullet {
namespace {

TEST(Pieces, GroupingHandOffPiecesHullsAndDrawingDoNotAllocate) {
    State state;
    const auto built = build_shell(state, sample_vase(0.3, 0.005, 48, 40).source(), sample_material(state));
    ASSERT_TRUE(built.ok()) << built.error();
    const Row<Shells> row = cut_by_label(state, built.value(), nearest_seed(ShellView(state, built.value()), 15, 1));
    const ShellView shell(state, row);
    std::vector<FragmentPart> parts(100);
    std::vector<PartMotion> motions(100);
    Range vertices{state.view_vertices.append(200000), 0, 200000},
        indices{state.view_indices.append(200000), 0, 200000};
    start_counting_allocations();
    const uint32_t count = group_fragments(shell, parts);
    const std::span<const FragmentPart> found(parts.data(), count);
    rigid_handoff(shell, {{}, {}, {}, 5}, found, motions);
    for (const FragmentPart& part : found) {
        const Row<Shells> piece = make_piece(state, row, part, 1);
        draw_shell(ShellView(state, piece), vertices, indices);
        mass_properties(shell_moments(ShellView(state, piece)));
        release_shell(state, piece);
    }
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
    EXPECT_GT(count, 5u);
}

TEST(Pieces, TwoRunsGiveTheSameBytes) {
    const auto run = [](State& state) {
        const auto built = build_shell(state, sample_sphere(0.2, 0.01, 4).source(), sample_material(state));
        const Row<Shells> row =
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
