// Shells that store each pair of a pair cell once, through a world: hit, held over frames, saved, broken, hit as
// pieces.
#include <gtest/gtest.h>

#include "components/state.hpp"
#include "sample_game/meshes.hpp"
#include "systems/models/thick_shell/stiffness/pair_cells.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

/// From how many cells on shells store pairs once, while this lives.
struct PairedFrom {
    explicit PairedFrom(uint32_t cells) { set_paired_cells(cells); }
    ~PairedFrom() { set_paired_cells(kPairedCells); }
};

Model vase() {
    CookSettings settings;
    settings.thickness = 0.005f;
    settings.longest_edge = 100;
    settings.thick_shell.measures_threshold = false;
    Result<Model> model = cook(view_of_mesh(make_vase(0.3f, 0.0125f)), settings);
    EXPECT_TRUE(model.ok());
    return std::move(model).value();
}

/// A board of 0.6 x 0.45 m, grain upright: its links are laid as pairs by several threads when a piece is hit again.
Model board() {
    CookSettings settings;
    settings.material = "wood";
    settings.grain = {0, 1, 0};
    settings.thickness = 0.01f;
    settings.longest_edge = 100;
    settings.thick_shell.measures_threshold = false;
    Result<Model> model = cook(view_of_mesh(make_wall(0.6f, 0.45f, 0.02f)), settings);
    EXPECT_TRUE(model.ok());
    return std::move(model).value();
}

struct Played {
    uint64_t hash = 0, cuts = 0;
    size_t pieces = 0;
    double mass = 0;
};

/// A ball hits a body in mid-air; when the run has begun the world is saved, and goes on as another.
Played play(const Model& model, uint32_t threads, bool is_saved, bool is_paired,
            const SphereSettings& ball = ball_at({0.01f, 0.13f, 0}, 0.3f, 8)) {
    Settings settings = small_settings();
    settings.threads = threads;
    settings.units_a_frame = 2'000'000;
    World world = make_world(settings);
    const BodyId body = world.spawn(world.add_model(model).value(), {}).value();
    (void)world.add_sphere(ball).value();
    EXPECT_TRUE(world.is_alive(body));
    uint32_t frames_open = 0;
    for (uint32_t frame = 0; frame < 60; ++frame) {
        world.step();
        frames_open += open_tasks(world) > 0;
        if (!is_saved || frames_open != 2 || open_tasks(world) == 0) continue;
        const Result<std::vector<uint8_t>> bytes = world.snapshot();
        EXPECT_TRUE(bytes.ok());
        World other = make_world(settings);
        const Result<void> restored = other.restore(bytes->data(), bytes->size());
        EXPECT_TRUE(restored.ok()) << restored.error();
        EXPECT_EQ(other.hash(), world.hash());
        world = std::move(other);
        is_saved = false;
    }
    EXPECT_FALSE(is_saved) << "the run was over before it could be saved";
    const State& state = state_of(world);
    for (uint32_t b = 0; b < state.bodies.size(); ++b)
        if (state.bodies.structure[b].exists() && state.structures.cells[state.bodies.structure[b]].count > 0) {
            EXPECT_EQ(stores_pairs_once(state.structures, state.bodies.structure[b]), is_paired);
        }
    const DamageCounts& counts = world.contents().data.counts;
    EXPECT_EQ(counts.dropped + counts.redone, 0u);
    return {world.hash(), counts.cuts, shells_of(world).size(), matter_of(world).mass};
}

TEST(PairedWorld, AHitGivesTheSameBytesOnAnyThreadsAndAfterASave) {
    const Model plain = vase();
    const Played twice = play(plain, 1, false, false);
    EXPECT_GT(twice.pieces, 2u);
    for (const uint32_t from : {0u, 1u}) {
        const PairedFrom paired(from);
        const Model model = vase();
        const Played first = play(model, 1, false, true);
        EXPECT_GT(first.pieces, 2u);
        EXPECT_NEAR(first.mass, twice.mass, 1e-9 * twice.mass);
        EXPECT_NE(first.hash, twice.hash) << "both stored pairs in the same way";
        for (const uint32_t threads : {1u, 2u, 3u, 8u})
            EXPECT_EQ(play(model, threads, true, true).hash, first.hash) << threads << " threads, from " << from;
    }
}

TEST(PairedWorld, WoodCracksInTheSameBytesOnAnyThreadsAndAfterASave) {
    const PairedFrom paired(0);
    const Model model = board();
    // Wood crushes under a small ball, whatever its speed, before a board bends to its strength.
    SphereSettings ball = ball_at({0.01f, 0.13f, 0}, 10, 20);
    ball.pose.position.z += 0.25f - ball.radius;
    ball.radius = 0.25f;
    const Played first = play(model, 1, false, true, ball);
    EXPECT_GT(first.cuts, 5u);  // it splits along the grain
    for (const uint32_t threads : {1u, 2u, 3u, 8u})
        EXPECT_EQ(play(model, threads, true, true, ball).hash, first.hash) << threads << " threads";
}

}  // namespace
}  // namespace cullet::test
