// Hits on large quick bodies run on a cut-out of the shell: rows are sound at every step, mass and momentum are kept,
// and nothing of it depends on threads, snapshots or earlier hits.
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "components/state.hpp"

#include <gtest/gtest.h>

#include "tests/support/large_hits.hpp"

namespace cullet::test {
namespace {

/// 9,000 vertices.
const Model& large_vase() {
    static const Model model = porcelain_vase(0.6f, 0.009f, FractureKind::Fine);
    return model;
}

Breakage vase_and_balls(const Settings& settings, uint32_t layers = 1) {
    Breakage b{make_world(settings), {}, {}};
    const ModelId id = b.world.add_model(large_vase()).value();
    SpawnSettings spawn;
    spawn.thick_shell.fracture = FractureMode::Quick;
    spawn.thick_shell.quick.layers = layers;
    spawn.thick_shell.quick.strain_limit = 0.02f;
    b.body = b.world.spawn(id, spawn).value();
    b.ball = b.world.add_sphere(ball_at({0.01f, 0.26f, 0.2f}, 0.5f, 40)).value();
    // A second one hits the cracked body 20 frames later.
    (void)b.world.add_sphere(ball_at({-0.05f, 0.33f, 10}, 0.5f, 40)).value();
    return b;
}

TEST(CutOut, RowsAreSoundWhenItIsFilledWhenItIsPutBackAndWhenPiecesAreOut) {
    for (const uint32_t layers : {1u, 2u}) {
        Breakage b = vase_and_balls(large_settings(1), layers);
        World* w = &b.world;
        uint32_t cut_outs = 0, whole = 0;
        bool was_open = false;  // in this frame; rows of all shells take a while to look at
        after_each_system(b.world, [&](const std::string& system) {
            State& state = state_of(*w);
            if (system != "fill_tasks" && system != "close_regions" && system != "make_births") return;
            bool is_open = false;
            for (uint32_t t = 0; t < state.tasks.size(); ++t) {
                if (static_cast<TaskState>(state.tasks.state[t]) == TaskState::Free) continue;
                is_open = true;
                if (system != "fill_tasks") continue;
                const bool is_new = state.tasks.opened_frame[t] == w->contents().data.step_info.frame;
                if (is_new && state.tasks.body[t] == b.body.index) ++(is_cut_out(state, t) ? cut_outs : whole);
                if (!is_cut_out(state, t)) continue;
                EXPECT_EQ(trouble_of_cut_out(state, t), "");
                EXPECT_LT(2 * state.shells.elements[state.shell_of(state.tasks.working[t])].count,
                          state.shells.elements[state.shell_of(state.tasks.source[t])].count);
            }
            if (system == "fill_tasks") was_open = is_open;
            if (was_open) {
                EXPECT_EQ(trouble_of_shells(state), "") << "after " << system;
            }
        });
        for (int frame = 0; frame < 40; ++frame) b.world.step();
        std::printf("%u layers: %u cut-outs, %u whole copies, %zu pieces\n", layers, cut_outs, whole,
                    shells_of(b.world).size());
        EXPECT_GE(cut_outs, 2u);
        EXPECT_LE(3 * whole, cut_outs) << "whole copies are for bodies whose spare rows are used up";
        EXPECT_GT(shells_of(b.world).size(), 1u) << "nothing came off";
    }
}

TEST(CutOut, HashesAreEqualOnOneTwoThreeAndEightThreads) {
    expect_same_hashes([](const Settings& settings) { return vase_and_balls(settings); }, 40);
}

TEST(CutOut, MassAndMomentumAreKeptWhereItBreaks) {
    Breakage b = vase_and_balls(large_settings(1));
    expect_matter_is_kept(b, 40);
}

TEST(CutOut, ASnapshotBetweenTwoFramesOfAHitGoesOnAsItWas) {
    const Settings settings = large_settings(1, 200'000);  // a few steps a frame
    Breakage b = vase_and_balls(settings);
    for (int frame = 0; frame < 60 && open_tasks(b.world) == 0; ++frame) b.world.step();
    for (int frame = 0; frame < 4; ++frame) b.world.step();
    ASSERT_GT(open_tasks(b.world), 0u);
    ASSERT_TRUE(is_cut_out(state_of(b.world), 0));
    expect_goes_on(b.world, settings, 60);
}

TEST(CutOut, FramesDoNotAllocate) {
    Breakage b = vase_and_balls(large_settings(1));
    expect_no_allocation(b, 40);
}

TEST(CutOut, AHitThatCracksNothingLeavesTheShellAsItWas) {
    Breakage b{make_world(large_settings(1)), {}, {}};
    const ModelId id = b.world.add_model(large_vase()).value();
    SpawnSettings spawn;
    spawn.thick_shell.fracture = FractureMode::Quick;
    spawn.thick_shell.quick.strain_limit = 1;
    b.body = b.world.spawn(id, spawn).value();
    b.ball = b.world.add_sphere(ball_at({0.01f, 0.26f, 0.2f}, 0.5f, 20)).value();
    State& state = state_of(b.world);
    const ShellView shell(state, state.bodies.structure[b.body.index]);
    const auto corners = [&] {
        const auto* first = state.elements.corner.data() + shell.element(0);
        return std::vector<std::array<uint32_t, 3>>(first, first + shell.element_count());
    };
    const auto before = corners();
    for (int frame = 0; frame < 30; ++frame) b.world.step();
    EXPECT_GT(b.world.contents().data.counts.opened, 0u);
    EXPECT_EQ(b.world.contents().data.counts.cuts, 0u);
    EXPECT_EQ(state.bodies.structure[b.body.index], shell.row);
    EXPECT_EQ(corners(), before);
    EXPECT_EQ(trouble_of_shells(state), "");
}

}  // namespace
}  // namespace cullet::test
