// Solids in a world: they are cooked, fall, break, and their pieces go on.
#include <gtest/gtest.h>

#include "components/body_id.hpp"
#include "sample_game/allocations.hpp"
#include "systems/structures/tetrahedra/skin.hpp"
#include "systems/world_contents.hpp"
#include "tests/support/closed_view.hpp"
#include "tests/support/same_bytes.hpp"
#include "tests/support/simple_meshes.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet {
namespace {

template <class T>
T value_of(Result<T> result) {
    if (!result) ADD_FAILURE() << result.error(), std::abort();
    return std::move(result).value();
}

CookSettings settings_for(const std::string& material) {
    CookSettings settings;
    settings.model = "lattice";
    settings.material = material;
    settings.lattice.cells = 500;
    return settings;
}

const Model& ring() {
    static const Model model = [] {
        Mesh mesh = test::torus_mesh(0.2, 0.06, 48, 24);
        mesh.name = "ring";
        return value_of(cook(test::view_of_mesh(mesh), settings_for("brick")));
    }();
    return model;
}

Settings settings_on(uint32_t threads, uint64_t units_a_frame = 8'000'000) {
    Settings settings;
    settings.threads = threads;
    settings.units_a_frame = units_a_frame;
    return settings;
}

BodyId spawn(World& world, const Model& model, Vec3 place, Vec3 velocity) {
    SpawnSettings settings;
    settings.pose.position = place;
    settings.pose.orientation = normalised(Quat{0.9f, 0.4f, 0.1f, 0.1f});
    settings.motion.velocity = velocity;
    return value_of(world.spawn(value_of(world.add_model(model)), settings));
}

/// A ring falls, and another one hangs in the way of a ball.
World two_rings(const Settings& settings) {
    World world = test::make_world(settings);
    test::add_floor(world);
    spawn(world, ring(), {0, 0.5f, 0}, {0, -12, 0});
    spawn(world, ring(), {1, 3, 0}, {});
    SphereSettings ball;
    ball.radius = 0.1f, ball.mass = 20;
    ball.pose.position = {1.2f, 3, 1};
    ball.motion.velocity = {0, 0, -15};
    EXPECT_TRUE(world.add_sphere(ball).ok());
    return world;
}

const State& state_of(const World& world) {
    return world.contents().data.state;
}

uint32_t solids(const World& world) {
    const State& state = state_of(world);
    uint32_t count = 0;
    for (uint32_t b = 0; b < state.bodies.size(); ++b)
        count += state.bodies.kind[b] != 0 && state.bodies.structure[b].exists() &&
                 !is_shell(state.structures, state.bodies.structure[b]);
    return count;
}

double mass_of_solids(const World& world) {
    const State& state = state_of(world);
    double mass = 0;
    for (uint32_t b = 0; b < state.bodies.size(); ++b)
        if (state.bodies.kind[b] != 0 && state.bodies.structure[b].exists()) mass += state.bodies.mass[b];
    for (uint32_t d = 0; d < state.debris.size(); ++d)
        if (state.debris.is_used[d]) mass += state.debris.mass[d];
    return mass;
}

TEST(SolidWorld, ARingIsCookedDrawnAndWeighedAsItsMesh) {
    const ModelReport& report = ring().report();
    const double volume = 2 * 9.8696044 * 0.2 * 0.06 * 0.06;  // of the smooth torus
    EXPECT_NEAR(report.mass, 1900 * volume, 0.03 * 1900 * volume);
    EXPECT_GT(report.elements, 400u);
    EXPECT_GT(report.first_crack_speed, 0);
    EXPECT_LT(report.first_crack_speed, 100);
}

TEST(SolidWorld, WhatFallsAndWhatIsStruckBreaksIntoClosedPiecesOfAllItsMass) {
    World world = two_rings(settings_on(1));
    const double before = mass_of_solids(world);
    for (int frame = 0; frame < 120; ++frame) world.step();
    EXPECT_GE(solids(world), 4u);
    EXPECT_NEAR(mass_of_solids(world), before, 1e-4 * before);
    const State& state = state_of(world);
    for (uint32_t b = 0; b < state.bodies.size(); ++b) {
        if (state.bodies.kind[b] == 0 || !state.bodies.structure[b].exists()) continue;
        const Result<void> closed = check_skin(state, state.bodies.structure[b]);
        EXPECT_TRUE(closed.ok()) << b << ": " << (closed ? "" : closed.error());
        const Vec3 at = state.bodies.position[b];
        EXPECT_TRUE(at.y > -0.5f || std::fabs(at.x) > 4 || std::fabs(at.z) > 4) << b << " is below the floor";
    }
}

TEST(SolidWorld, AnyNumberOfThreadsGivesTheSameBytes) {
    World one = two_rings(settings_on(1));
    (void)test::hashes_of(one, 60);
    EXPECT_GE(solids(one), 4u);
    test::expect_same_on_threads([](uint32_t threads) { return two_rings(settings_on(threads)); }, 60);
}

TEST(SolidWorld, AWorldThatIsLoadedInMidBreakGoesOnWithTheSameBytes) {
    World world = two_rings(settings_on(1, 4'000'000));
    const uint32_t loads = test::expect_loads(
        world, [] { return test::make_world(settings_on(2, 4'000'000)); }, 90,
        [&](int frame) {
            bool is_open = false;
            for (uint32_t t = 0; t < state_of(world).tasks.size(); ++t)
                is_open = is_open || static_cast<TaskState>(state_of(world).tasks.state[t]) != TaskState::Free;
            return is_open || frame % 20 == 0;
        });
    EXPECT_GT(loads, 3u);
    EXPECT_GE(solids(world), 4u);
}

TEST(SolidWorld, ItsModelFileGivesTheSameWorld) {
    const test::OwnFolder folder("cullet_solids");
    const std::string path = folder.file("ring.cmodel");
    ASSERT_TRUE(write_model(ring(), path).ok());
    const Model read = value_of(read_model(path));
    EXPECT_EQ(read.report().mass, ring().report().mass);
    World cooked = test::make_world(settings_on(1)), from_file = test::make_world(settings_on(1));
    for (World* world : {&cooked, &from_file}) test::add_floor(*world);
    spawn(cooked, ring(), {0, 0.5f, 0}, {0, -12, 0});
    spawn(from_file, read, {0, 0.5f, 0}, {0, -12, 0});
    EXPECT_EQ(test::hashes_of(from_file, 30), test::hashes_of(cooked, 30));
}

TEST(SolidWorld, ARecordingReplaysOnAnyNumberOfThreads) {
    test::expect_replays(settings_on(1), 40, [](World& world) {
        test::add_floor(world);
        spawn(world, ring(), {0, 0.5f, 0}, {0, -12, 0});
        for (int frame = 0; frame < 40; ++frame) world.step();
        EXPECT_GE(solids(world), 2u);
    });
}

TEST(SolidWorld, FramesDoNotAllocate) {
    World world = two_rings(settings_on(1));
    start_counting_allocations();
    for (int frame = 0; frame < 60; ++frame) world.step();
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
    EXPECT_GE(solids(world), 4u);
}

TEST(SolidWorld, WhatIsWholeBreaksInTheFrameOfTheTouchOrIsHeldAndNoStepIsLong) {
    World world = two_rings(settings_on(1));
    uint64_t most_owed = 0;
    for (int frame = 0; frame < 60; ++frame) {
        world.step();
        const State& state = state_of(world);
        for (uint32_t t = 0; t < state.tasks.size(); ++t) {
            most_owed = std::max(most_owed, state.tasks.units_owed[t]);
            const Row<Tasks> task(t);
            const bool is_open = static_cast<TaskState>(state.tasks.state[t]) == TaskState::Running &&
                                 !is_ahead(state.tasks, t) && state.structures.generation[state.tasks.source[t]] == 0;
            if (is_open) {
                EXPECT_FALSE(state.tasks.is_late[task]) << frame;
            }
        }
    }
    // Of a frame's 8 million; all of the skin at once took more than these.
    EXPECT_LE(most_owed, 1'250'000u);
    const DamageCounts& counts = world.contents().data.counts;
    EXPECT_GE(counts.broke, 2u);
    EXPECT_EQ(counts.first_breaks, 2u);
}

TEST(SolidWorld, WhatIsNoSolidOrDoesNotBreakIsRefusedWithASentence) {
    Mesh mesh = test::torus_mesh(0.2, 0.06, 24, 12);
    mesh.name = "ring";
    const Result<Model> steel = cook(test::view_of_mesh(mesh), settings_for("steel"));
    ASSERT_FALSE(steel.ok());
    EXPECT_NE(steel.error().find("lattice breaks what is brittle"), std::string::npos) << steel.error();
    SpawnSettings pinned;
    const Box box{{5, 5, 5}, {6, 6, 6}};
    pinned.pins = &box, pinned.pin_count = 1;
    World world = test::make_world(settings_on(1));
    const Result<BodyId> body = world.spawn(value_of(world.add_model(ring())), pinned);
    ASSERT_FALSE(body.ok());
    EXPECT_NE(body.error().find("no part of the surface lies in any of the 1 pin boxes"), std::string::npos)
        << body.error();
}

Mesh box_round_origin(Vec3d size, uint32_t cuts) {
    Mesh mesh = test::box_mesh(size, cuts);
    for (Vec3& p : mesh.positions) p = p - (0.5 * size).to_float();
    return mesh;
}

/// A bar of brick, 1 m long, that lies along x.
const Model& bar() {
    static const Model model = [] {
        Mesh mesh = box_round_origin({1, 0.12, 0.12}, 4);
        mesh.name = "bar";
        return value_of(cook(test::view_of_mesh(mesh), settings_for("brick")));
    }();
    return model;
}

/// Held at one end.
BodyId spawn_pinned(World& world, Vec3 place) {
    SpawnSettings settings;
    settings.pose.position = place;
    const Box box{{-1, -1, -1}, {-0.4f, 1, 1}};
    settings.pins = &box, settings.pin_count = 1;
    return value_of(world.spawn(value_of(world.add_model(bar())), settings));
}

struct Pieces {
    uint32_t held = 0, free = 0;
    double held_reach = -1e30, lowest = 1e30;  // m along x of what is held; y of what is not
};
Pieces pieces_of(const World& world) {
    const State& state = state_of(world);
    Pieces found;
    for (uint32_t b = 0; b < state.bodies.size(); ++b) {
        if (state.bodies.kind[b] == 0 || !state.bodies.structure[b].exists()) continue;
        const bool is_held = static_cast<BodyKind>(state.bodies.kind[b]) == BodyKind::Static;
        EXPECT_EQ(is_held, state.bodies.has_pins[b] != 0);
        (is_held ? found.held : found.free) += 1;
        if (is_held)
            found.held_reach = std::max(found.held_reach, Vec3d(state.bodies.centre[b]).x);
        else
            found.lowest = std::min(found.lowest, double{state.bodies.position[b].y});
    }
    return found;
}

TEST(SolidWorld, WhatPinsHoldStaysAndWhatBreaksOffItFalls) {
    for (const uint64_t units : {8'000'000u, 3'000'000u}) {
        World world = test::make_world(settings_on(1, units));
        spawn_pinned(world, {0, 2, 0});
        for (int frame = 0; frame < 10; ++frame) world.step();
        EXPECT_EQ(pieces_of(world).held, 1u);
        SphereSettings ball;
        ball.radius = 0.06f, ball.mass = 8;
        ball.pose.position = {0.3f, 2.5f, 0};
        ball.motion.velocity = {0, -15, 0};
        ASSERT_TRUE(world.add_sphere(ball).ok());
        for (int frame = 0; frame < 60; ++frame) {
            world.step();
            if (frame == 3) {  // in mid-break
                const std::vector<uint8_t> bytes = value_of(world.snapshot());
                World loaded = test::make_world(settings_on(1, units));
                ASSERT_TRUE(loaded.restore(bytes.data(), bytes.size()).ok());
                world.step(), loaded.step();
                ASSERT_EQ(loaded.hash(), world.hash());
            }
        }
        const Pieces pieces = pieces_of(world);
        EXPECT_EQ(pieces.held, 1u);
        EXPECT_GE(pieces.free, 1u);
        EXPECT_LT(pieces.held_reach, -0.15);  // the middle of what is left of a bar whose free end is gone
        EXPECT_LT(pieces.lowest, 1);
        EXPECT_NEAR(mass_of_solids(world), bar().report().mass, 1e-4 * bar().report().mass);
    }
}

/// Momentum of all that moves freely, N s.
Vec3d momentum_of(const World& world) {
    const State& state = state_of(world);
    Vec3d sum;
    for (uint32_t b = 0; b < state.bodies.size(); ++b)
        if (state.bodies.kind[b] != 0 && state.bodies.structure[b].exists())
            sum += state.bodies.mass[b] * Vec3d(state.bodies.velocity[b]);
    for (uint32_t d = 0; d < state.debris.size(); ++d)
        if (state.debris.is_used[d]) sum += double{state.debris.mass[d]} * Vec3d(state.debris.velocity[d]);
    return sum;
}

TEST(SolidWorld, AnExplosionBreaksWhatIsNearPushesWhatIsFarAndGivesBothWhatItGivesARigidOne) {
    uint32_t solids_after[2];
    Vec3d momenta[2];
    for (int k = 0; k < 2; ++k) {
        Settings settings = settings_on(1);
        settings.gravity = {};
        World world = test::make_world(settings);
        SpawnSettings spawning;
        spawning.strength_scale = k == 0 ? 1.0f : 1000.0f;
        ASSERT_TRUE(world.spawn(value_of(world.add_model(bar())), spawning).ok());
        world.step();
        ExplosionSettings explosion;
        explosion.centre = {0.1f, -0.4f, 0.02f}, explosion.radius = 1.2f, explosion.impulse = 20'000;
        ASSERT_TRUE(world.explode(explosion).ok());
        for (int frame = 0; frame < 20; ++frame) world.step();
        solids_after[k] = solids(world);
        momenta[k] = momentum_of(world);
    }
    EXPECT_GE(solids_after[0], 2u);
    EXPECT_EQ(solids_after[1], 1u);
    EXPECT_GT(momenta[1].y, 10);
    EXPECT_NEAR(momenta[0].y, momenta[1].y, 0.02 * momenta[1].y);
}

/// A column of brick, 0.6 m high, with something heavy put on its top.
World laden_column(float mass, bool has_foot) {
    static const Model model = [] {
        Mesh mesh = box_round_origin({0.15, 0.6, 0.15}, 3);
        mesh.name = "column";
        return value_of(cook(test::view_of_mesh(mesh), settings_for("brick")));
    }();
    World world = test::make_world(settings_on(1));
    test::add_floor(world);
    SpawnSettings settings;
    settings.pose.position = {0, 0.301f, 0};
    const Box foot{{-1, -1, -1}, {1, -0.27f, 1}};
    if (has_foot) settings.pins = &foot, settings.pin_count = 1;
    EXPECT_TRUE(world.spawn(value_of(world.add_model(model)), settings).ok());
    for (int frame = 0; frame < 5; ++frame) world.step();
    SphereSettings load;
    load.radius = 0.2f, load.mass = mass;
    load.pose.position = {0, 0.803f, 0};
    EXPECT_TRUE(world.add_sphere(load).ok());
    return world;
}

TEST(SolidWorld, AHundredTonnesBreakAColumnAndAFewKilogramsDoNot) {
    for (const bool has_foot : {false, true}) {
        World light = laden_column(5, has_foot);
        for (int frame = 0; frame < 60; ++frame) light.step();
        EXPECT_EQ(solids(light), 1u) << has_foot;
        World heavy = laden_column(100'000, has_foot);
        for (int frame = 0; frame < 60; ++frame) heavy.step();
        EXPECT_GE(solids(heavy), 2u) << has_foot;
    }
}

TEST(SolidWorld, AColumnThatLosesItsFootFalls) {
    World world = laden_column(0.01f, true);
    SphereSettings ball;
    ball.radius = 0.08f, ball.mass = 80;
    ball.pose.position = {0, 0.16f, 0.6f};
    ball.motion.velocity = {0, 0, -14};
    ASSERT_TRUE(world.add_sphere(ball).ok());
    for (int frame = 0; frame < 120; ++frame) world.step();
    const Pieces pieces = pieces_of(world);
    EXPECT_GE(pieces.free, 1u);
    const State& state = state_of(world);
    for (uint32_t b = 0; b < state.bodies.size(); ++b)
        if (state.bodies.kind[b] != 0 && state.bodies.structure[b].exists() && !state.bodies.has_pins[b]) {
            EXPECT_LT(to_world(pose_of(state.bodies, b), state.bodies.centre[b].to_float()).y, 0.2f);
        }
}

/// A press comes down on the lying bar at half a metre a second, until 2 cm are left of its 12.
World pressed_bar(const Settings& settings) {
    World world = test::make_world(settings);
    test::add_floor(world);
    SpawnSettings spawning;
    spawning.pose.position = {0, 0.061f, 0};
    EXPECT_TRUE(world.spawn(value_of(world.add_model(bar())), spawning).ok());
    KinematicSettings press;
    press.half_extents = {1, 0.2f, 1};
    press.pose.position = {0, 0.335f, 0};
    press.motion.velocity = {0, -0.5f, 0};
    EXPECT_TRUE(world.add_kinematic_box(press).ok());
    return world;
}
constexpr int kPressFrames = 13;  // that it moves

TEST(SolidWorld, WhatAPressComesDownOnIsPartedPastTheLastGenerationAndKeepsItsMass) {
    World world = pressed_bar(settings_on(1));
    uint8_t oldest = 0;
    for (int frame = 0; frame < kPressFrames + 90; ++frame) {
        if (frame == kPressFrames) {
            const State& state = state_of(world);
            for (uint32_t b = 0; b < state.bodies.size(); ++b)
                if (static_cast<BodyKind>(state.bodies.kind[b]) == BodyKind::Kinematic) {
                    ASSERT_TRUE(world.set_motion({b, state.bodies.generation[b]}, {}).ok());
                }
        }
        world.step();
        const State& state = state_of(world);
        for (uint32_t b = 0; b < state.bodies.size(); ++b)
            if (state.bodies.kind[b] != 0 && state.bodies.structure[b].exists())
                oldest = std::max(oldest, state.structures.generation[state.bodies.structure[b]]);
    }
    EXPECT_GT(oldest, DamageSettings().generations);
    EXPECT_NEAR(mass_of_solids(world), bar().report().mass, 1e-3 * bar().report().mass);
    const DamageCounts& counts = world.contents().data.counts;
    EXPECT_GT(counts.broke, 10u);
}

TEST(SolidWorld, WhatIsPressedIsTheSameOnAnyNumberOfThreadsAfterALoadAndAllocatesNothing) {
    test::expect_same_on_threads([](uint32_t threads) { return pressed_bar(settings_on(threads, 4'000'000)); }, 30);
    World world = pressed_bar(settings_on(1, 4'000'000));
    const uint32_t loads = test::expect_loads(
        world, [] { return test::make_world(settings_on(2, 4'000'000)); }, 30,
        [&](int) {
            for (uint32_t t = 0; t < state_of(world).tasks.size(); ++t)
                if (static_cast<TaskState>(state_of(world).tasks.state[t]) != TaskState::Free) return true;
            return false;
        });
    EXPECT_GT(loads, 3u);
    World counted = pressed_bar(settings_on(1));
    start_counting_allocations();
    for (int frame = 0; frame < 30; ++frame) counted.step();
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
    EXPECT_GT(counted.contents().data.counts.broke, 3u);
}

}  // namespace
}  // namespace cullet
