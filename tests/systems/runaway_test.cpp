// Runs that go wrong leave a sound world; and causes for which runs went wrong without need.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "components/state.hpp"
#include "systems/structures/shell/explosion.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/prism.hpp"
#include "tests/support/sample_shells.hpp"
#include "tests/systems/models/thick_shell/soft/soft_world.hpp"

namespace cullet::test {
namespace {

BodyId add_quick_vase(World& world, uint32_t layers) {
    SpawnSettings spawn;
    spawn.thick_shell.fracture = FractureMode::Quick;
    spawn.thick_shell.quick.layers = layers;
    return world.spawn(world.add_model(small_vase()).value(), spawn).value();
}

uint64_t dropped_of(const World& world) {
    return world.contents().data.counts.dropped;
}

/// Every number of the tables is one, and another world takes the snapshot.
void expect_sound(World& world) {
    EXPECT_EQ(state_of(world).validate(), "");
    const Result<std::vector<uint8_t>> saved = world.snapshot();
    ASSERT_TRUE(saved.ok()) << saved.error();
    World other = make_world(small_settings());
    const Result<void> restored = other.restore(saved->data(), saved->size());
    ASSERT_TRUE(restored.ok()) << restored.error();
    EXPECT_EQ(other.hash(), world.hash());
}

// The pieces of dJ over their elements' masses are the most that it can give: what hangs together gets less.
TEST(Runaway, AnExplosionGivesAQuickBodyNoMoreEnergyThanItsImpulseHas) {
    for (const uint32_t layers : {1u, 2u}) {
        World world = make_world(small_settings());
        const BodyId body = add_quick_vase(world, layers);
        const ExplosionSettings explosion{.centre = {0, 0.14f, 0.22f}, .radius = 0.45f, .impulse = 350};
        const ShellView shell(state_of(world), state_of(world).bodies.structure[body.index]);
        const ExplosionSums sums =
            measure_explosion(shell, {explosion.centre, explosion.radius, explosion.impulse}, {});
        ASSERT_TRUE(world.explode(explosion).ok());
        double most = 0;
        for (int frame = 0; frame < 20; ++frame) world.step(), most = std::max(most, matter_of(world).kinetic_energy);
        EXPECT_EQ(dropped_of(world), 0u) << layers << " layers";
        EXPECT_GT(world.contents().data.counts.broke, 0u) << layers << " layers";
        EXPECT_LE(most, 0.5 * sums.size * double{sums.speed}) << layers << " layers";
        const Matter matter = matter_of(world);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(matter.momentum[k], sums.impulse[k], 1e-3 * length(sums.impulse)) << layers << " layers";
    }
}

TEST(Runaway, ADroppedRunLeavesAWorldThatCanBeSaved) {
    for (const uint32_t layers : {1u, 2u}) {
        Settings settings = small_settings();
        settings.units_a_frame = 2000;
        World world = make_world(settings);
        const BodyId body = add_quick_vase(world, layers);
        ASSERT_TRUE(world.push_impact(body, {.place = {0, 0.15f, 0.1f}, .normal = {0, 0, -1}, .mass = 0.5f}).ok());
        world.step();
        State& state = state_of(world);
        ASSERT_EQ(static_cast<TaskState>(state.tasks.state[0]), TaskState::Running) << layers << " layers";
        const Range rows = state.shells.vertices[state.shell_of(state.tasks.working[0])];
        for (uint32_t v = rows.first; v < rows.first + rows.count; ++v) state.vertices.velocity.set(v, {1e30f, 0, 0});
        for (int frame = 0; frame < 3000 && open_tasks(world) > 0; ++frame) world.step();
        EXPECT_EQ(dropped_of(world), 1u) << layers << " layers";
        expect_sound(world);
    }
}

TEST(Runaway, AStrikerOfSomeGramsEndsNoQuickRun) {
    for (const float mass : {1e-5f, 1e-4f, 3e-4f, 1e-3f, 1e-2f})
        for (const float speed : {1.3f, 4.1f, 7.7f, 19.9f}) {
            World world = make_world(small_settings());
            const BodyId body = add_quick_vase(world, 1);
            PushSettings push{.place = {0, 0.15f, 0.1f}, .normal = {0, 0, -1}, .approach_speed = speed, .mass = mass};
            ASSERT_TRUE(world.push_impact(body, push).ok());
            for (int frame = 0; frame < 5; ++frame) world.step();
            EXPECT_EQ(dropped_of(world), 0u) << mass << " kg at " << speed << " m/s";
        }
}

TEST(Runaway, ASoftBodyOfNoNumbersIsPutBackAndFrozenAndTouchesNothingElse) {
    Sheet sheet = make_sheet(rubber_sheet(), soft_settings(), frame_pins());
    throw_ball(sheet, 0.3f, 5);
    for (int frame = 0; frame < 60 && !(sheet.is_awake() && sheet.state().soft_bodies.striker_count[sheet.soft()] > 0);
         ++frame)
        sheet.world.step();
    ASSERT_TRUE(sheet.is_awake());
    const Motion before = sheet.world.motion(sheet.ball).value();
    for (uint32_t v = 0; v < sheet.shell().vertex_count(); ++v)
        sheet.state().vertices.velocity.set(sheet.shell().vertex(v), {v % 2 ? 1e30f : -1e30f, 0, 0});
    sheet.world.step();
    EXPECT_EQ(sheet.world.events().faults.count, 1u);
    EXPECT_EQ(length(sheet.world.motion(sheet.ball).value().velocity - before.velocity), 0);
    EXPECT_EQ(sheet.state().validate(), "");
    sheet.world.step();
    EXPECT_EQ(sheet.world.events().faults.count, 0u) << "once";
    expect_sound(sheet.world);
}

// 3 kg at 10 m/s were given at once to vertices of some grams.
TEST(Runaway, APushOfAHeavyStrikerMakesNoPartOfASoftBodyFasterThanTwiceItsSpeed) {
    for (const bool is_pinned : {false, true})
        for (const float speed : {10.0f, 40.0f}) {
            Sheet sheet = make_sheet(rubber_sheet(), soft_settings(), is_pinned ? frame_pins() : std::vector<Box>{});
            const PushSettings push{
                .place = {0.01f, 0.21f, 0}, .normal = {0, 0, -1}, .approach_speed = speed, .mass = 3, .radius = 0.02f};
            ASSERT_TRUE(sheet.world.push_impact(sheet.body, push).ok());
            float fastest = 0;
            after_each_system(sheet.world, [&](const std::string& system) {
                if (system != "take_blows") return;
                for (uint32_t v = 0; v < sheet.shell().vertex_count(); ++v)
                    fastest = std::max(fastest, length(sheet.state().vertices.velocity[sheet.shell().vertex(v)]));
            });
            sheet.world.step();
            EXPECT_GT(fastest, 0.5f * speed);
            EXPECT_LE(fastest, 2.001f * speed);
            after_each_system(sheet.world, [](const std::string&) {});
            uint32_t faults = sheet.world.events().faults.count;
            for (int frame = 0; frame < 40; ++frame) sheet.world.step(), faults += sheet.world.events().faults.count;
            EXPECT_EQ(faults, 0u) << speed << " m/s" << (is_pinned ? ", pinned" : "");
        }
}

TEST(Runaway, AnElementThatIsTurnedInsideOutHasAnInertia) {
    for (int turned = 1; turned < 8; ++turned) {
        State state;
        const Row<Materials> material = sample_material(state);
        const SampleSurface grid = sample_grid(0.1, 0.1, 2, 2, 0.01);
        const Result<Row<Structures>> made = build_shell(state, grid.source(), material);
        ASSERT_TRUE(made.ok()) << made.error();
        const ShellView shell(state, *made);
        const auto corner = state.elements.corner[shell.element(0)];
        for (int k = 0; k < 3; ++k)
            if (turned & (1 << k)) {
                const uint32_t row = shell.vertex(corner[k]);
                state.vertices.inward.set(row, -state.vertices.inward[row]);
            }
        ASSERT_LT(prism_volume(load_prism(shell, 0)), 0.99 * state.elements.volume[shell.element(0)]);
        const MassProperties p = mass_properties(element_moments(shell, 0));
        EXPECT_EQ(p.mass, state.elements.mass[shell.element(0)]);
        EXPECT_GT(p.inertia.xx, 0) << turned;
        EXPECT_GT(p.inertia.xx * p.inertia.yy, p.inertia.xy * p.inertia.xy) << turned;
        EXPECT_GT(determinant(p.inertia), 0) << turned;
    }
}

}  // namespace
}  // namespace cullet::test
