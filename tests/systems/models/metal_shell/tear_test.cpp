// Metal that is stretched too far tears: what is torn, what it keeps, and that it goes on as any other body.
#include <gtest/gtest.h>

#include "components/body_id.hpp"
#include "sample_game/allocations.hpp"
#include "tests/support/closed_view.hpp"
#include "tests/support/same_bytes.hpp"
#include "tests/systems/models/metal_shell/panels.hpp"

namespace cullet {
namespace {

template <class T>
T value_of(Result<T> result) {
    if (!result) ADD_FAILURE() << result.error(), std::abort();
    return std::move(result).value();
}

Model cook_panel(float tear_strain = 0) {
    const Mesh sheet = metal_sheet(1, 1, 40, 40);
    CookSettings settings;
    settings.material = "steel", settings.thickness = 1e-3f, settings.longest_edge = 100;
    settings.metal_shell.tear_strain = tear_strain;
    return value_of(cook(test::view_of_mesh(sheet), settings));
}
const Model& panel() {
    static const Model model = cook_panel();
    return model;
}
const Model& box() {
    static const Model model = test::cook_metal(test::box_mesh({0.3, 0.3, 0.3}, 24));
    return model;
}

Settings settings_on(uint32_t threads) {
    Settings settings = test::small_settings();
    settings.gravity = {0, -9.81f, 0};
    settings.threads = threads;
    return settings;
}

/// Held along its border, in the x-y plane.
BodyId spawn_panel(World& world, const Model& model) {
    constexpr float kHalf = 0.5f, kRim = 0.01f, kOut = 1;
    const Box pins[] = {{{-kOut, -kOut, -kOut}, {-kHalf + kRim, kOut, kOut}},
                        {{kHalf - kRim, -kOut, -kOut}, {kOut, kOut, kOut}},
                        {{-kOut, -kOut, -kOut}, {kOut, -kHalf + kRim, kOut}},
                        {{-kOut, kHalf - kRim, -kOut}, {kOut, kOut, kOut}}};
    SpawnSettings settings;
    settings.pose.position = {0, 1, 0};
    settings.pins = pins, settings.pin_count = 4;
    return value_of(world.spawn(value_of(world.add_model(model)), settings));
}
/// Free, in mid-air.
BodyId spawn_free(World& world, const Model& model, Vec3 place, Vec3 velocity = {}) {
    SpawnSettings settings;
    settings.pose.position = place;
    settings.motion.velocity = velocity;
    return value_of(world.spawn(value_of(world.add_model(model)), settings));
}
/// Comes along -z to what stands at z = 0.
BodyId throw_ball(World& world, float speed, float mass = 50, float radius = 0.1f) {
    return value_of(world.add_sphere(test::ball_at({0.1f, 1, 0}, mass, speed, radius)));
}

/// Sides of cracks.
uint32_t crack_sides(const World& world, BodyId body) {
    const State& state = world.contents().data.state;
    const Row<Structures> structure = state.bodies.structure[body_row(state.bodies, body)];
    const Range elements = state.shells.elements[state.shell_of(structure)];
    uint32_t count = 0;
    for (uint32_t e = elements.first; e < elements.first + elements.count; ++e)
        for (uint32_t k = 0; k < 3 && !(state.elements.flags[e] & kDead); ++k)
            count += state.elements.edge_kind[e][k] == static_cast<uint8_t>(EdgeKind::Crack);
    return count;
}
uint32_t vertices_of(const World& world, BodyId body) {
    const State& state = world.contents().data.state;
    return state.shells.vertices[state.shell_of(state.bodies.structure[body_row(state.bodies, body)])].count;
}
double mass_of_all(const World& world) {
    const State& state = world.contents().data.state;
    double mass = 0;
    for (const BodyId id : test::shells_of(world)) mass += value_of(world.mass(id));
    for (uint32_t d = 0; d < state.debris.size(); ++d)
        if (state.debris.is_used[d]) mass += state.debris.mass[d];
    return mass;
}
void expect_sound(World& world) {
    EXPECT_EQ(test::state_of(world).validate(), "");
    for (const BodyId id : test::shells_of(world)) EXPECT_EQ(test::find_open_edge(value_of(world.view(id))), "");
}

constexpr float kThrough = 19, kHard = 40;  // m/s

World shots(const Settings& settings) {
    World world = test::make_world(settings);
    test::add_floor(world);
    spawn_panel(world, panel());
    throw_ball(world, kHard);
    spawn_free(world, box(), {2, 0.5f, 0});
    EXPECT_TRUE(world.add_sphere(test::ball_at({2.13f, 0.66f, 0.3f}, 20, 45, 0.06f)).ok());
    return world;
}

TEST(Tear, WhatIsStretchedNoFartherThanItBearsStaysWhole) {
    World world = test::make_world(settings_on(2));
    const BodyId sheet = spawn_panel(world, panel());
    throw_ball(world, 8);
    for (int frame = 0; frame < 30; ++frame) world.step();
    EXPECT_GT(test::deepest(world, sheet), 0.03);
    EXPECT_EQ(crack_sides(world, sheet), 0u);
}

TEST(Tear, AFastBallGoesThroughAndLeavesAHoleWithPetals) {
    World world = test::make_world(settings_on(2));
    const BodyId sheet = spawn_panel(world, panel());
    const uint32_t before = vertices_of(world, sheet);
    const BodyId ball = throw_ball(world, kThrough);
    const float speed = kThrough;
    for (int frame = 0; frame < 12; ++frame) world.step();
    const Vec3 velocity = value_of(world.motion(ball)).velocity;
    EXPECT_LT(velocity.z, -0.1f * speed) << "it goes on";
    EXPECT_GT(velocity.z, -0.9f * speed) << "and is slower";
    EXPECT_GT(crack_sides(world, sheet), 20u);
    EXPECT_GT(vertices_of(world, sheet), before + 20) << "vertices were split";
    EXPECT_GT(test::deepest(world, sheet), 0.1) << "petals";
    EXPECT_NEAR(mass_of_all(world), panel().report().mass, 1e-9 * panel().report().mass);
    expect_sound(world);
}

TEST(Tear, AHarderShotPunchesAPieceOutThatFliesOnWithTheBall) {
    World world = test::make_world(settings_on(2));
    spawn_panel(world, panel());
    const BodyId ball = throw_ball(world, kHard);
    for (int frame = 0; frame < 12; ++frame) world.step();
    const std::vector<BodyId> shells = test::shells_of(world);
    ASSERT_EQ(shells.size(), 2u);
    EXPECT_LT(value_of(world.motion(shells[1])).velocity.z, -0.3f * kHard);
    EXPECT_LT(value_of(world.motion(ball)).velocity.z, -0.3f * kHard);
    EXPECT_NEAR(mass_of_all(world), panel().report().mass, 1e-6 * panel().report().mass);
    expect_sound(world);
}

TEST(Tear, APieceDentsAgain) {
    Settings settings = settings_on(2);
    settings.break_share = 0, settings.break_elements = 0;  // it is small
    World world = test::make_world(settings);
    spawn_panel(world, panel());
    throw_ball(world, kHard);
    for (int frame = 0; frame < 6; ++frame) world.step();
    const std::vector<BodyId> shells = test::shells_of(world);
    ASSERT_EQ(shells.size(), 2u);
    const BodyId piece = shells[1];
    State& state = test::state_of(world);
    const MetalView metal(state, state.bodies.structure[body_row(state.bodies, piece)]);
    ASSERT_TRUE(metal.row.exists());
    EXPECT_EQ(metal.vertex_count(), metal.shell.vertex_count());
    EXPECT_EQ(metal.element_count(), metal.shell.element_count());
    uint32_t springs = 0;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) springs += metal.vertices().spring_count[metal.vertex(v)];
    EXPECT_GT(springs, 2 * metal.element_count());
    const double before = test::deepest(world, piece);
    SphereSettings wall;
    wall.radius = 0.1f, wall.mass = 500;
    wall.pose.position = value_of(world.pose(piece)).position;
    wall.pose.position.z -= 1;
    const Vec3 centre = state.bodies.centre[body_row(state.bodies, piece)].to_float();
    wall.pose.position = wall.pose.position + centre;
    wall.motion.velocity = {0, 0, 20};
    ASSERT_TRUE(world.add_sphere(wall).ok());
    for (int frame = 0; frame < 20; ++frame) world.step();
    EXPECT_LT(test::deepest(world, piece), before - 0.002) << "it was pushed back";
    expect_sound(world);
}

TEST(Tear, WhatIsFreeKeepsItsMomentumWithTheBall) {
    World world = test::make_world(test::small_settings());
    spawn_free(world, panel(), {0, 1, 0});
    throw_ball(world, 60);
    const auto before = test::matter_of(world).momentum;
    for (int frame = 0; frame < 12; ++frame) world.step();
    EXPECT_GE(test::shells_of(world).size(), 1u);
    const auto after = test::matter_of(world).momentum;
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(after[k], before[k], 1e-4 * 50 * 60) << k;
    expect_sound(world);
}

TEST(Tear, TheGameSaysBeyondWhichStrainItTears) {
    const auto sides_at = [](float tear_strain, float speed) {
        World world = test::make_world(settings_on(1));
        const BodyId sheet = spawn_panel(world, cook_panel(tear_strain));
        throw_ball(world, speed);
        for (int frame = 0; frame < 12; ++frame) world.step();
        return crack_sides(world, sheet);
    };
    EXPECT_EQ(sides_at(10, kHard), 0u) << "nothing ever tears";
    EXPECT_GT(sides_at(0.05f, 8), 0u) << "tears early";
    CookSettings settings;
    settings.material = "steel", settings.thickness = 1e-3f;
    settings.metal_shell.tear_strain = -1;
    const Mesh sheet = metal_sheet(1, 1, 4, 4);
    EXPECT_NE(cook(test::view_of_mesh(sheet), settings).error().find("tear_strain"), std::string::npos);
}

TEST(Tear, AChargeBlowsAHoleIntoAPlate) {
    World world = test::make_world(settings_on(2));
    const BodyId sheet = spawn_panel(world, panel());
    ExplosionSettings explosion;
    explosion.centre = {0, 1, 0.15f}, explosion.radius = 1, explosion.impulse = 40000;
    ASSERT_TRUE(world.explode(explosion).ok());
    for (int frame = 0; frame < 10; ++frame) world.step();
    EXPECT_GT(crack_sides(world, sheet), 20u);
    EXPECT_NEAR(mass_of_all(world), panel().report().mass, 1e-6 * panel().report().mass);
    expect_sound(world);
}

TEST(Tear, AsOftenAsItIsShot) {
    World world = test::make_world(settings_on(2));
    const BodyId sheet = spawn_panel(world, panel());
    uint32_t sides = 0;
    for (int shot = 0; shot < 6; ++shot) {
        const float across = 0.14f * static_cast<float>(shot) - 0.35f;
        (void)value_of(world.add_sphere(test::ball_at({across, 1.25f, 0}, 5, 70, 0.04f)));
        for (int frame = 0; frame < 8; ++frame) world.step();
        EXPECT_GT(crack_sides(world, sheet), sides) << shot;
        sides = crack_sides(world, sheet);
    }
    expect_sound(world);
}

// A sheet waits for nothing after a hit: shots in frames that follow one another all go through, wherever shards of the
// ones before still scrape the sheet.
TEST(Tear, AsFastAsItIsShot) {
    for (const int frames_between : {1, 2, 3, 6, 7}) {
        World world = test::make_world(settings_on(2));
        spawn_panel(world, panel());
        std::vector<BodyId> balls;
        for (int shot = 0; shot < 4; ++shot) {
            const float across = 0.2f * static_cast<float>(shot) - 0.3f;
            balls.push_back(value_of(world.add_sphere(test::ball_at({across, 1.25f, 0}, 5, 70, 0.04f))));
            for (int frame = 0; frame < frames_between; ++frame) world.step();
        }
        for (int frame = 0; frame < 4; ++frame) world.step();
        for (const BodyId ball : balls)
            EXPECT_LT(value_of(world.motion(ball)).velocity.z, -50) << frames_between << " frames between";
    }
}

TEST(Tear, ShotsOnOneSpotStaySane) {
    World world = test::make_world(settings_on(2));
    spawn_panel(world, panel());
    for (int shot = 0; shot < 8; ++shot) {
        const BodyId ball = throw_ball(world, shot % 2 ? kHard : kThrough);
        for (int frame = 0; frame < 20; ++frame) world.step();
        ASSERT_TRUE(world.remove(ball).ok());
        expect_sound(world);
    }
    EXPECT_NEAR(mass_of_all(world), panel().report().mass, 1e-6 * panel().report().mass);
}

TEST(Tear, AnyNumberOfThreadsGivesTheSameBytes) {
    World one = shots(settings_on(1));
    (void)test::hashes_of(one, 40);
    EXPECT_GE(test::shells_of(one).size(), 3u);
    test::expect_same_on_threads([](uint32_t threads) { return shots(settings_on(threads)); }, 40);
}

TEST(Tear, AWorldThatIsLoadedGoesOnWithTheSameBytes) {
    World world = shots(settings_on(1));
    EXPECT_GE(test::expect_loads(
                  world, [] { return test::make_world(settings_on(2)); }, 32, [](int frame) { return frame % 4 == 0; }),
              8u);
}

TEST(Tear, ARecordingReplaysOnAnyNumberOfThreads) {
    test::expect_replays(settings_on(1), 30, [](World& world) {
        spawn_panel(world, panel());
        throw_ball(world, kHard);
        for (int frame = 0; frame < 30; ++frame) world.step();
        EXPECT_EQ(test::shells_of(world).size(), 2u);
    });
}

TEST(Tear, FramesDoNotAllocate) {
    World world = shots(settings_on(1));
    start_counting_allocations();
    for (int frame = 0; frame < 40; ++frame) world.step();
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
    EXPECT_GE(test::shells_of(world).size(), 3u);
}

}  // namespace
}  // namespace cullet
