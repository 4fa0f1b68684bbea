// LayerSettings in worlds: the published layout, gamma, area and volume energies, of quick bodies and of soft ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sample_game/allocations.hpp"
#include "tests/systems/models/thick_shell/soft/soft_world.hpp"

namespace cullet::test {
namespace {

LayerSettings layers_of(LayerLayout layout, float length_factor, float energy) {
    LayerSettings layers;
    layers.layout = layout;
    layers.length_factor = length_factor;
    layers.area_energy = layers.volume_energy = energy;
    return layers;
}
const LayerSettings kAll[] = {
    layers_of(LayerLayout::Sandwich, 0, 0),   layers_of(LayerLayout::Sandwich, 2, 0),
    layers_of(LayerLayout::Crossed, 0, 0),    layers_of(LayerLayout::Sandwich, 0, 0.5f),
    layers_of(LayerLayout::Crossed, 2, 0.5f),
};

TEST(Layers, OutOfRangeAreRefusedWithASentence) {
    World world = make_world(small_settings());
    const ModelId id = world.add_model(small_vase()).value();
    const auto refused = [&](auto change, const std::string& name) {
        SpawnSettings spawn;
        change(spawn.thick_shell.springs);
        const Result<BodyId> body = world.spawn(id, spawn);
        ASSERT_FALSE(body.ok()) << name;
        EXPECT_NE(body.error().find("springs." + name), std::string::npos) << body.error();
    };
    refused([](LayerSettings& l) { l.layout = static_cast<LayerLayout>(2); }, "layout");
    refused([](LayerSettings& l) { l.length_factor = 0.5f; }, "length_factor");
    refused([](LayerSettings& l) { l.length_factor = 5.1f; }, "length_factor");
    refused([](LayerSettings& l) { l.area_energy = -1; }, "area_energy");
    refused([](LayerSettings& l) { l.volume_energy = std::nanf(""); }, "volume_energy");
}

// A vase in mid-air and a ball, quick, two layers.
Breakage quick_break(const LayerSettings& layers, uint32_t threads) {
    Settings settings = small_settings();
    settings.threads = threads;
    Breakage b{make_world(settings), {}, {}};
    SpawnSettings spawn;
    spawn.thick_shell.fracture = FractureMode::Quick;
    spawn.thick_shell.quick.layers = 2;
    spawn.thick_shell.springs = layers;
    b.body = b.world.spawn(b.world.add_model(small_vase()).value(), spawn).value();
    b.ball = b.world.add_sphere(ball_at({0.01f, 0.13f, 0}, 0.3f, 60)).value();
    return b;
}

TEST(Layers, OfQuickBodiesDecideHowTheyBreakTheSameOnAnyNumberOfThreads) {
    std::set<uint64_t> ends;
    for (const LayerSettings& layers : kAll) {
        uint64_t alone = 0;
        for (const uint32_t threads : {1u, 2u, 3u, 8u}) {
            Breakage b = quick_break(layers, threads);
            const Matter before = matter_of(b.world);
            for (int frame = 0; frame < 12; ++frame) b.world.step();
            const Matter after = matter_of(b.world);
            const uint64_t hash = b.world.hash();
            if (threads == 1) {
                alone = hash;
                EXPECT_GT(shells_of(b.world).size(), 1u) << "it breaks";
                EXPECT_NEAR(after.mass, before.mass, 1e-9);  // debris counted
                EXPECT_LE(after.kinetic_energy, before.kinetic_energy * 1.000001);
            }
            EXPECT_EQ(hash, alone) << threads << " threads";
        }
        ends.insert(alone);
    }
    EXPECT_EQ(ends.size(), std::size(kAll)) << "each setting decides something";
}

TEST(Layers, OfAQuickHitAreKeptInSnapshots) {
    for (const LayerSettings& layers : {kAll[4], kAll[3]}) {
        Settings settings = small_settings();
        settings.units_a_frame = 300'000;  // the hit takes some frames
        Breakage slow{make_world(settings), {}, {}};
        SpawnSettings spawn;
        spawn.thick_shell.fracture = FractureMode::Quick, spawn.thick_shell.quick.layers = 2,
        spawn.thick_shell.springs = layers;
        slow.body = slow.world.spawn(slow.world.add_model(small_vase()).value(), spawn).value();
        slow.ball = slow.world.add_sphere(ball_at({0.01f, 0.13f, 0}, 0.3f, 60)).value();
        while (open_tasks(slow.world) == 0) slow.world.step();
        const std::vector<uint8_t> saved = slow.world.snapshot().value();
        for (int frame = 0; frame < 20; ++frame) slow.world.step();
        const uint64_t hash = slow.world.hash();
        ASSERT_TRUE(slow.world.restore(saved.data(), saved.size()).ok());
        for (int frame = 0; frame < 20; ++frame) slow.world.step();
        EXPECT_EQ(slow.world.hash(), hash);
    }
}

/// How far the free end of a rubber sheet, held at the other, hangs down at most under a tenth of gravity, m. It is
/// over how much softer than rubber its springs are, for what a frame can afford depends on the layout, too.
double sag_of(const LayerSettings& layers) {
    Settings settings = soft_settings();
    settings.gravity = {0, 0, -0.981f};
    settings.units_a_frame = 200'000'000;
    World world = make_world(settings);
    SpawnSettings spawn;
    spawn.thick_shell.springs = layers;
    const Box pin{{-1, -1, -1}, {-0.14f, 1, 1}};
    spawn.pins = &pin, spawn.pin_count = 1;
    const Result<ModelId> model = world.add_model(rubber_sheet());
    const Result<BodyId> body = world.spawn(model.value(), spawn);
    EXPECT_TRUE(body.ok()) << body.error();
    const State& state = state_of(world);
    const double softening = state.soft_bodies.softening[state.bodies.soft[body->index]];
    float lowest = 0;
    for (int frame = 0; frame < 60; ++frame) {
        world.step();
        const BodyView view = world.view(*body).value();
        for (uint32_t v = 0; v < view.vertex_count; ++v) lowest = std::min(lowest, view.vertices[v].position.z);
    }
    return -double{lowest} / softening;
}

// B5: gamma 2 crossed bends 12 times too stiffly, and the sandwich not at all.
TEST(Layers, OfSoftBodiesBendAsTheirLayoutSays) {
    const double own = sag_of({}), sandwich = sag_of(layers_of(LayerLayout::Sandwich, 2, 0)),
                 crossed = sag_of(layers_of(LayerLayout::Crossed, 2, 0));
    EXPECT_GT(own, 0);
    EXPECT_NEAR(sandwich / own, 1, 0.25);
    EXPECT_LT(crossed, 0.25 * sandwich);
}

}  // namespace
}  // namespace cullet::test
