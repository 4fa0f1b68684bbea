// Hits on large quick bodies run on a cut-out of the shell: rows are sound at every step, mass and momentum are kept,
// and nothing of it depends on threads, snapshots or earlier hits.
#include "systems/quick/cut_out.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sample_game/allocations.hpp"
#include "sample_game/meshes.hpp"
#include "systems/cook/check_shell_rows.hpp"
#include "tests/support/random_hits.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

/// 9,000 vertices; cracks of fine fracture stay near the hit.
const Model& large_vase() {
    static const Model model = [] {
        const Mesh mesh = make_vase(0.6f, 0.009f);
        CookSettings settings;
        settings.material = "porcelain", settings.thickness = 0.005f;
        settings.longest_edge = 100;
        settings.measures_threshold = false;
        settings.fracture = FractureKind::Fine;
        Result<Model> cooked = cook(view_of_mesh(mesh), settings);
        EXPECT_TRUE(cooked.ok()) << cooked.error();
        return std::move(cooked).value();
    }();
    return model;
}

Settings settings_of(uint32_t threads, uint64_t units = 1'000'000'000) {
    Settings settings = small_settings();
    settings.threads = threads;
    settings.units_a_frame = units;
    settings.debris_share = 0, settings.debris_elements = 3;  // pieces of fine fracture are small
    settings.limits = {512, 8, 1u << 17, 1u << 18, 8, 1u << 20, 512};
    return settings;
}

Breakage vase_and_balls(const Settings& settings, uint32_t layers = 1) {
    Breakage b{make_world(settings), {}, {}};
    const ModelId id = b.world.add_model(large_vase()).value();
    SpawnSettings spawn;
    spawn.fracture = FractureMode::Quick;
    spawn.quick.layers = layers;
    spawn.quick.strain_limit = 0.02f;
    b.body = b.world.spawn(id, spawn).value();
    b.ball = b.world.add_sphere(ball_at({0.01f, 0.26f, 0.2f}, 0.5f, 40)).value();
    // A second one hits the cracked body 20 frames later.
    (void)b.world.add_sphere(ball_at({-0.05f, 0.33f, 10}, 0.5f, 40)).value();
    return b;
}

std::vector<uint64_t> hashes_of(World& world, uint32_t frames) {
    std::vector<uint64_t> hashes;
    for (uint32_t frame = 0; frame < frames; ++frame) {
        world.step();
        hashes.push_back(world.hash());
    }
    return hashes;
}

/// Empty, or what is wrong with some shell's rows.
std::string trouble_of(State& state) {
    for (uint32_t row = 0; row < state.shells.size(); ++row) {
        if (state.shells.users[row] == 0) continue;
        Wear wear = Wear::Worn;
        for (uint32_t t = 0; t < state.tasks.size(); ++t)
            if (static_cast<TaskState>(state.tasks.state[t]) != TaskState::Free && state.tasks.shell[t] == row &&
                is_cut_out(state, t))
                wear = Wear::CutOut;
        const Result<void> sound = check_shell_rows(ShellView(state, Row<Shells>(row)), wear, "shell", "");
        if (!sound.ok()) return sound.error();
    }
    return {};
}

TEST(CutOut, RowsAreSoundWhenItIsFilledWhenItIsPutBackAndWhenPiecesAreOut) {
    for (const uint32_t layers : {1u, 2u}) {
        Breakage b = vase_and_balls(settings_of(1), layers);
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
                if (state.tasks.body[t] == b.body.index) ++(is_cut_out(state, t) ? cut_outs : whole);
                if (!is_cut_out(state, t)) continue;
                EXPECT_EQ(trouble_of_cut_out(state, t), "");
                EXPECT_LT(2 * state.shells.elements[state.tasks.shell[t]].count,
                          state.shells.elements[state.tasks.source[t]].count);
            }
            if (system == "fill_tasks") was_open = is_open;
            if (was_open) {
                EXPECT_EQ(trouble_of(state), "") << "after " << system;
            }
        });
        for (int frame = 0; frame < 40; ++frame) b.world.step();
        std::printf("%u layers: %u cut-outs, %u whole copies, %zu pieces\n", layers, cut_outs, whole,
                    shells_of(b.world).size());
        EXPECT_GE(cut_outs, 2u);
        EXPECT_EQ(whole, 0u);
        EXPECT_GT(shells_of(b.world).size(), 1u) << "nothing came off";
    }
}

TEST(CutOut, HashesAreEqualOnOneTwoThreeAndEightThreads) {
    std::vector<uint64_t> first;
    for (const uint32_t threads : {1u, 2u, 3u, 8u}) {
        Breakage b = vase_and_balls(settings_of(threads));
        const std::vector<uint64_t> hashes = hashes_of(b.world, 40);
        if (threads == 1)
            first = hashes;
        else
            EXPECT_EQ(hashes, first) << threads << " threads";
    }
}

TEST(CutOut, MassAndMomentumAreKeptWhereItBreaks) {
    Breakage b = vase_and_balls(settings_of(1));
    World* w = &b.world;
    Matter before{};
    uint64_t broke = 0;
    uint32_t breaks = 0;
    double worst = 0, worst_mass = 0;
    const double scale = std::fabs(matter_of(b.world).momentum[2]);
    after_each_system(b.world, [&](const std::string& system) {
        if (system == "settle_tasks") before = matter_of(*w), broke = w->contents().data.counts.broke;
        if (system != "make_births" || w->contents().data.counts.broke == broke) return;
        ++breaks;
        const Matter after = matter_of(*w);
        for (int k = 0; k < 3; ++k) worst = worse(worst, std::fabs(after.momentum[k] - before.momentum[k]) / scale);
        worst_mass = worse(worst_mass, std::fabs(after.mass / before.mass - 1));
        EXPECT_LE(after.kinetic_energy, 1.0001 * before.kinetic_energy);
    });
    for (int frame = 0; frame < 40; ++frame) b.world.step();
    std::printf("%u breaks, momentum off by %.1e of the balls', mass by %.1e, hidden rounding %.1e\n", breaks, worst,
                worst_mass, b.world.contents().data.counts.worst_rounding);
    EXPECT_GT(breaks, 0u);
    EXPECT_LT(worst, 1e-6);
    EXPECT_LT(worst_mass, 1e-6);
    EXPECT_LT(b.world.contents().data.counts.worst_rounding, 2e-4);
}

TEST(CutOut, ASnapshotBetweenTwoFramesOfAHitGoesOnAsItWas) {
    const Settings settings = settings_of(1, 200'000);  // a few steps a frame
    Breakage b = vase_and_balls(settings);
    for (int frame = 0; frame < 60 && open_tasks(b.world) == 0; ++frame) b.world.step();
    for (int frame = 0; frame < 4; ++frame) b.world.step();
    ASSERT_GT(open_tasks(b.world), 0u);
    ASSERT_TRUE(is_cut_out(state_of(b.world), 0));
    const auto bytes = b.world.snapshot();
    ASSERT_TRUE(bytes.ok()) << bytes.error();
    World other = make_world(settings);
    const Result<void> loaded = other.restore(bytes->data(), bytes->size());
    ASSERT_TRUE(loaded.ok()) << loaded.error();
    EXPECT_EQ(hashes_of(b.world, 60), hashes_of(other, 60));
}

TEST(CutOut, FramesDoNotAllocate) {
    Breakage b = vase_and_balls(settings_of(1));
    start_counting_allocations();
    for (int frame = 0; frame < 40; ++frame) b.world.step();
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
    EXPECT_GT(shells_of(b.world).size(), 1u);
}

TEST(CutOut, AHitThatCracksNothingLeavesTheShellAsItWas) {
    Breakage b{make_world(settings_of(1)), {}, {}};
    const ModelId id = b.world.add_model(large_vase()).value();
    SpawnSettings spawn;
    spawn.fracture = FractureMode::Quick;
    spawn.quick.strain_limit = 1;
    b.body = b.world.spawn(id, spawn).value();
    b.ball = b.world.add_sphere(ball_at({0.01f, 0.26f, 0.2f}, 0.5f, 20)).value();
    State& state = state_of(b.world);
    const ShellView shell(state, state.bodies.shell[b.body.index]);
    const auto corners = [&] {
        const auto* first = state.elements.corner.data() + shell.element(0);
        return std::vector<std::array<uint32_t, 3>>(first, first + shell.element_count());
    };
    const auto before = corners();
    for (int frame = 0; frame < 30; ++frame) b.world.step();
    EXPECT_GT(b.world.contents().data.counts.opened, 0u);
    EXPECT_EQ(b.world.contents().data.counts.cuts, 0u);
    EXPECT_EQ(state.bodies.shell[b.body.index], shell.row);
    EXPECT_EQ(corners(), before);
    EXPECT_EQ(trouble_of(state), "");
}

}  // namespace
}  // namespace cullet::test
