// Blows that the game asks for: pushes and explosions, between the call and what comes of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "components/state.hpp"
#include "systems/structures/shell/explosion.hpp"
#include "tests/support/simple_meshes.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

Vec3d momentum_of(const World& world) {
    const Matter m = matter_of(world);
    return {m.momentum[0], m.momentum[1], m.momentum[2]};
}
/// What damage gave to what does not move, less what blows gave; and what the solver gave to bodies that stood held.
Vec3d given_of(const World& world) {
    const double* given = world.contents().data.counts.impulse_to_static;
    return Vec3d(given[0], given[1], given[2]) + world.contents().data.rigid->impulse_to_static();
}

/// A vase at rest in mid-air, whose middle is about (0, 0.15, 0).
BodyId add_vase(World& world, Vec3 place = {}, bool is_breakable = true) {
    const Result<ModelId> model = world.add_model(small_vase());
    EXPECT_TRUE(model.ok()) << model.error();
    SpawnSettings settings;
    settings.pose.position = place;
    settings.is_breakable = is_breakable;
    const Result<BodyId> body = world.spawn(*model, settings);
    EXPECT_TRUE(body.ok()) << body.error();
    return *body;
}

/// Rest place of the body's vertex nearest to a place in its frame.
Vec3 nearest_vertex(World& world, BodyId body, Vec3 place) {
    const State& state = state_of(world);
    const ShellView shell(state_of(world), state.bodies.structure[body.index]);
    Vec3 nearest{1e9f, 0, 0};
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const Vec3 rest = state.vertices.rest[shell.vertex(v)];
        if (length(rest - place) < length(nearest - place)) nearest = rest;
    }
    return nearest;
}

/// From the side, at mid-height.
PushSettings side_push(const World& world, BodyId body, float speed, float mass = 0.3f) {
    const Bodies& bodies = world.contents().data.state.bodies;
    PushSettings push;
    push.place = bodies.position[body.index] + bodies.centre[body.index].to_float() + Vec3{0, 0, 0.1f};
    push.normal = {0, 0, -1};
    push.approach_speed = speed;
    push.mass = mass;
    push.radius = 0.03f;
    return push;
}

TEST(Push, AHarmlessOneMovesTheBodyAsARigidStrikerWould) {
    World world = make_world(small_settings());
    const BodyId body = add_vase(world);
    const PushSettings push = side_push(world, body, 0.02f, 0.5f);
    const Bodies& bodies = state_of(world).bodies;
    const Vec3d arm(nearest_vertex(world, body, push.place) - bodies.centre[body.index].to_float());
    const Vec3d n(push.normal), turn = cross(arm, n);
    const double body_inverse = 1 / bodies.mass[body.index] + dot(turn, inverse(bodies.inertia[body.index]) * turn);
    const double wanted = (1 + bodies.restitution[body.index]) * 0.02 / (body_inverse + 1 / 0.5);
    ASSERT_TRUE(world.push_impact(body, push).ok());
    EXPECT_EQ(length(momentum_of(world)), 0) << "it is taken by the next step";
    world.step();
    EXPECT_NEAR(momentum_of(world).z, -wanted, 1e-5 * wanted);
    EXPECT_NEAR(given_of(world).z, wanted, 1e-5 * wanted);
    EXPECT_EQ(world.contents().data.counts.opened, 0u);
    EXPECT_EQ(state_of(world).blows.size(), 0u);
}

TEST(Push, OneBesideTheBodyIsMeantForTheNearestVertex) {
    const auto struck = [](bool is_beside, bool is_breakable) {
        World world = make_world(small_settings());
        const BodyId body = add_vase(world, {}, is_breakable);
        PushSettings push = side_push(world, body, 0.02f);
        push.place = state_of(world).bodies.centre[body.index].to_float() + Vec3{0.3f, 0.02f, 0.01f};
        if (!is_beside) push.place = nearest_vertex(world, body, push.place);
        EXPECT_TRUE(world.push_impact(body, push).ok());
        Motion motion;
        after_each_system(world, [&](const std::string& system) {  // the solver damps spins
            if (system == "open_tasks") motion = world.motion(body).value();
        });
        world.step();
        after_each_system(world, [](const std::string&) {});
        return motion;
    };
    for (const bool is_breakable : {true, false}) {
        const Motion beside = struck(true, is_breakable), on = struck(false, is_breakable);
        EXPECT_GT(length(on.angular_velocity), 0);
        EXPECT_LT(length(beside.velocity - on.velocity), 1e-6f * length(on.velocity));
        EXPECT_LT(length(beside.angular_velocity - on.angular_velocity), 1e-6f * length(on.angular_velocity));
    }
}

TEST(Push, OneBesideTheBodyIsToldWhereItStrikes) {
    World world = make_world(small_settings());
    const BodyId body = add_vase(world, {1, 2, 3});
    PushSettings push = side_push(world, body, 10);
    push.place.z += 0.4f;
    const Vec3 wanted = nearest_vertex(world, body, push.place - Vec3{1, 2, 3}) + Vec3{1, 2, 3};
    ASSERT_TRUE(world.push_impact(body, push).ok());
    world.step();
    ASSERT_EQ(world.events().impacts.count, 1u);
    for (const ImpactEvent& e : world.events().impacts) EXPECT_LT(length(e.place - wanted), 1e-5f);
}

/// A vase in mid-air after pushes from the side at mid-height, the n-th of masses[n] kg.
World pushed_vase(const std::vector<float>& masses, float speed) {
    World world = make_world(small_settings());
    const BodyId body = add_vase(world);
    for (const float mass : masses) EXPECT_TRUE(world.push_impact(body, side_push(world, body, speed, mass)).ok());
    for (int frame = 0; frame < 20; ++frame) world.step();
    return world;
}

TEST(Push, TwoAtOnePlaceAreOneOfTwiceTheMass) {
    const World two = pushed_vase({0.15f, 0.15f}, 8), one = pushed_vase({0.3f}, 8), half = pushed_vase({0.15f}, 8);
    EXPECT_GT(two.contents().data.counts.broke, 0u);
    EXPECT_EQ(all_bodies(two).size(), all_bodies(one).size());
    EXPECT_NEAR(momentum_of(two).z, momentum_of(one).z, -1e-6 * momentum_of(one).z);
    EXPECT_LT(momentum_of(one).z, 1.2 * momentum_of(half).z) << "twice the mass gives clearly more";
    EXPECT_LT(length(momentum_of(two) + given_of(two)), 2e-4 * 0.3 * 8);
}

// The place is taken by what pushes the other way: nothing is merged, and nothing lost.
TEST(Push, OneAgainstAnotherAtTheSamePlaceMovesTheBodyAndWaits) {
    World world = make_world(small_settings());
    const BodyId body = add_vase(world);
    PushSettings push = side_push(world, body, 8);
    ASSERT_TRUE(world.push_impact(body, push).ok());
    push.normal = {0, 0, 1};
    ASSERT_TRUE(world.push_impact(body, push).ok());
    double paid = 0;
    after_each_system(world, [&](const std::string& system) {
        if (system == "open_tasks" && paid == 0) paid = -given_of(world).z;
    });
    world.step();
    after_each_system(world, [](const std::string&) {});
    EXPECT_GT(paid, 0) << "as between rigid bodies";
    for (int frame = 0; frame < 40; ++frame) world.step();
    EXPECT_EQ(state_of(world).blows.size(), 0u);
    EXPECT_LT(length(momentum_of(world) + given_of(world)), 5e-4 * 0.3 * 8);
}

TEST(Push, AHardOneBreaksTheBodyAndKeepsTheBooksOfMomentum) {
    World world = make_world(small_settings());
    const BodyId body = add_vase(world);
    const double mass = world.mass(body).value();
    ASSERT_TRUE(world.push_impact(body, side_push(world, body, 10)).ok());
    for (int frame = 0; frame < 30; ++frame) {
        world.step();
        const double lost = length(momentum_of(world) + given_of(world));
        EXPECT_LT(lost, 2e-4 * std::max(1e-3, length(given_of(world)))) << "frame " << frame;
    }
    EXPECT_GT(all_bodies(world).size(), 1u);
    EXPECT_EQ(world.contents().data.counts.broke, 1u);
    EXPECT_NEAR(matter_of(world).mass, mass, 1e-6 * mass);
    EXPECT_LT(momentum_of(world).z, -0.3);
    EXPECT_EQ(state_of(world).blows.size(), 0u);
}

// What the striker could give at most: it stops dead at the first contact and comes back with what crushing leaves it.
TEST(Push, TheBodyGetsAtMostTwiceTheStrikersMomentum) {
    World world = make_world(small_settings());
    const BodyId body = add_vase(world);
    ASSERT_TRUE(world.push_impact(body, side_push(world, body, 12)).ok());
    for (int frame = 0; frame < 20; ++frame) world.step();
    const double given = given_of(world).z;
    EXPECT_GT(given, 0.1 * 0.3 * 12);
    EXPECT_LT(given, 2 * 0.3 * 12);
}

TEST(Push, TwoInOneFrameBothHaveTheirPatch) {
    World world = make_world(small_settings());
    const BodyId body = add_vase(world);
    PushSettings first = side_push(world, body, 6), second = first;
    second.place.z = -first.place.z + 2 * world.pose(body)->position.z;
    second.normal = {0, 0, 1};
    ASSERT_TRUE(world.push_impact(body, first).ok());
    ASSERT_TRUE(world.push_impact(body, second).ok());
    uint32_t contacts = 0;
    after_each_system(world, [&](const std::string& system) {
        if (system == "start_tasks")
            contacts = std::max(contacts, static_cast<uint32_t>(state_of(world).tasks.contact_count[0]));
    });
    world.step();
    EXPECT_EQ(contacts, 2u);
    EXPECT_EQ(world.events().impacts.count, 2u);
    for (int frame = 0; frame < 30; ++frame) world.step();
    // Two equal ones from both sides: each gives the body as much as the other takes back, but for the jitter of the
    // mesh and of the strength.
    EXPECT_GT(world.contents().data.counts.broke, 0u);
    EXPECT_LT(length(momentum_of(world) + given_of(world)), 2e-4 * 0.3 * 6);
}

TEST(Push, OneOnABodyWhoseHitStillRunsMovesItAtOnceAndWaits) {
    Settings settings = small_settings();
    settings.units_a_frame = 1'500'000;
    World world = make_world(settings);
    const BodyId body = add_vase(world);
    ASSERT_TRUE(world.push_impact(body, side_push(world, body, 10)).ok());
    world.step();
    ASSERT_EQ(open_tasks(world), 1u);
    const double before = given_of(world).z;
    PushSettings second = side_push(world, body, 8);
    second.place.y += 0.05f;
    ASSERT_TRUE(world.push_impact(body, second).ok());
    world.step();
    EXPECT_GT(given_of(world).z - before, 0) << "paid as between rigid bodies";
    EXPECT_EQ(state_of(world).blows.size(), 2u);
    const uint64_t opened = world.contents().data.counts.opened;
    for (int frame = 0; frame < 200; ++frame) world.step();
    EXPECT_GT(world.contents().data.counts.opened, opened) << "the piece that owns the place was looked at";
    EXPECT_EQ(state_of(world).blows.size(), 0u);
    EXPECT_LT(length(momentum_of(world) + given_of(world)), 1e-3 * 0.3 * 10);
}

TEST(Push, BallsAndUnbreakableBodiesAreOnlyMoved) {
    World world = make_world(small_settings());
    const BodyId vase = add_vase(world, {}, false);
    const BodyId ball = world.add_sphere(ball_at({2, 0, 0}, 1, 0)).value();
    ASSERT_TRUE(world.push_impact(vase, side_push(world, vase, 20)).ok());
    PushSettings push;
    push.place = {2, 0, 0.03f};
    push.normal = {0, 0, -1};
    push.approach_speed = 3;
    push.mass = 1;
    const float at_start = world.pose(ball)->position.z;
    push.place.z += at_start;
    ASSERT_TRUE(world.push_impact(ball, push).ok());
    world.step();
    EXPECT_EQ(world.contents().data.counts.opened, 0u);
    // Two balls of a kilogram, 3 m/s, restitution 0.2: (1 + 0.2) 3 / 2.
    EXPECT_NEAR(world.motion(ball)->velocity.z, -1.8f, 1e-4f);
    EXPECT_LT(world.motion(vase)->velocity.z, 0);
}

TEST(Blows, WhatIsNotSoundIsRefusedInASentence) {
    World world = make_world(small_settings());
    const BodyId body = add_vase(world);
    const float infinite = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const auto refused_push = [&](auto change, const char* word) {
        PushSettings push = side_push(world, body, 5);
        change(push);
        const Result<void> done = world.push_impact(body, push);
        EXPECT_FALSE(done.ok());
        EXPECT_NE(done.error().find(word), std::string::npos) << done.error();
    };
    refused_push([&](PushSettings& p) { p.place.x = nan; }, "push.place");
    refused_push([&](PushSettings& p) { p.normal = {0, 0, 0}; }, "push.normal");
    refused_push([&](PushSettings& p) { p.normal = {0, nan, 1}; }, "push.normal");
    refused_push([&](PushSettings& p) { p.approach_speed = 0; }, "push.approach_speed");
    refused_push([&](PushSettings& p) { p.approach_speed = infinite; }, "push.approach_speed");
    refused_push([&](PushSettings& p) { p.mass = -1; }, "push.mass");
    refused_push([&](PushSettings& p) { p.mass = infinite; }, "push.mass");
    refused_push([&](PushSettings& p) { p.radius = -0.1f; }, "push.radius");
    const auto refused_explosion = [&](auto change, const char* word) {
        ExplosionSettings e;
        e.impulse = 100;
        change(e);
        const Result<void> done = world.explode(e);
        EXPECT_FALSE(done.ok());
        EXPECT_NE(done.error().find(word), std::string::npos) << done.error();
    };
    refused_explosion([&](ExplosionSettings& e) { e.centre.y = infinite; }, "explosion.centre");
    refused_explosion([&](ExplosionSettings& e) { e.radius = 0; }, "explosion.radius");
    refused_explosion([&](ExplosionSettings& e) { e.radius = nan; }, "explosion.radius");
    refused_explosion([&](ExplosionSettings& e) { e.impulse = -1; }, "explosion.impulse");
    refused_explosion([&](ExplosionSettings& e) { e.impulse = 0; }, "explosion.impulse");
    refused_explosion([&](ExplosionSettings& e) { e.pressure = nan; }, "explosion.pressure");
    refused_explosion([&](ExplosionSettings& e) { e.seconds = -1; }, "explosion.seconds");
    const auto refused_cut = [&](auto change, const char* word) {
        CutSettings c;
        change(c);
        const Result<void> done = world.cut(body, c);
        EXPECT_FALSE(done.ok());
        EXPECT_NE(done.error().find(word), std::string::npos) << done.error();
    };
    const Vec3 line[] = {{0, 0, 0}, {0, 0, 1}, {nan, 0, 0}};
    refused_cut([&](CutSettings& c) { c.place.z = nan; }, "cut.place");
    refused_cut([&](CutSettings& c) { c.normal = {0, 2, 0}; }, "cut.normal");
    refused_cut([&](CutSettings& c) { c.points = line, c.point_count = 1; }, "cut.points");
    refused_cut([&](CutSettings& c) { c.points = line, c.point_count = 33; }, "cut.points");
    refused_cut([&](CutSettings& c) { c.points = nullptr, c.point_count = 4; }, "cut.points");
    refused_cut([&](CutSettings& c) { c.points = line, c.point_count = 3; }, "cut.points[2]");
    refused_cut([&](CutSettings& c) { c.points = line, c.point_count = 2; }, "cut.direction");  // along itself
    ASSERT_TRUE(world.remove(body).ok());
    EXPECT_NE(world.push_impact(body, {}).error().find("names nothing that is alive"), std::string::npos);
    EXPECT_NE(world.cut(body, {}).error().find("names nothing that is alive"), std::string::npos);
    const BodyId ball = world.add_sphere({}).value();
    EXPECT_NE(world.cut(ball, {}).error().find("not spawned from a model"), std::string::npos);
    const BodyId firm = add_vase(world, {}, false);
    EXPECT_NE(world.cut(firm, {}).error().find("is_breakable"), std::string::npos) << world.cut(firm, {}).error();
    CookSettings steel;
    steel.model = "thick_shell", steel.material = "steel", steel.thickness = 0.004f, steel.longest_edge = 100;
    const Mesh plate = sheet_mesh(0.3, 0.3, 4, 4);
    const BodyId tin = world.spawn(world.add_model(cook(view_of_mesh(plate), steel).value()).value()).value();
    EXPECT_NE(world.cut(tin, {}).error().find("ductile"), std::string::npos) << world.cut(tin, {}).error();
    EXPECT_EQ(state_of(world).blows.size(), 0u);
}

TEST(Blows, MoreThanThereIsRoomForAreRefusedAndNamed) {
    Settings settings = small_settings();
    settings.limits.queued_hits = 4;
    settings.limits.bodies = 8;
    World world = make_world(settings);
    ExplosionSettings e;
    e.impulse = 1;
    for (int i = 0; i < 12; ++i) EXPECT_TRUE(world.explode(e).ok());
    const Result<void> refused = world.explode(e);
    EXPECT_NE(refused.error().find("limits.queued_hits"), std::string::npos) << refused.error();
    world.step();
    EXPECT_TRUE(world.explode(e).ok());
}

TEST(Blows, ARemovedBodyTakesItsOwnAlong) {
    World world = make_world(small_settings());
    const BodyId body = add_vase(world);
    ASSERT_TRUE(world.push_impact(body, side_push(world, body, 10)).ok());
    ASSERT_TRUE(world.remove(body).ok());
    EXPECT_EQ(state_of(world).blows.size(), 0u);
    world.step();
}

// A far explosion on a flat plate that faces it: s (1 - d/R)^2 A, and nothing on its edge-on side.
TEST(Explosion, APlateThatFacesItGetsTheFormulasImpulse) {
    World world = make_world(small_settings());
    SpawnSettings settings;
    settings.is_breakable = false;
    const BodyId pane = world.spawn(world.add_model(small_pane()).value(), settings).value();
    const State& state = state_of(world);
    const ShellView shell(state_of(world), state.bodies.structure[pane.index]);
    // The plate's normal from its elements.
    Vec3d area;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const auto& c = state.elements.corner[shell.element(e)];
        const Vec3 a = state.vertices.rest[shell.vertex(c[0])], b = state.vertices.rest[shell.vertex(c[1])],
                   d = state.vertices.rest[shell.vertex(c[2])];
        area += 0.5 * Vec3d(cross(b - a, d - a));
    }
    const Vec3d n = normalised(area);
    const Vec3 middle = to_world(Pose{}, state.bodies.centre[pane.index].to_float());
    const float reach = 100, distance = 40;
    for (const float side : {1.0f, -1.0f}) {
        const Explosion explosion{middle + (side * distance) * n.to_float(), reach, 50};
        const ExplosionSums sums = measure_explosion(shell, explosion, {});
        const double wanted = 50 * 0.6 * 0.6 * length(area);
        EXPECT_NEAR(dot(sums.impulse, n), -side * wanted, 2e-3 * wanted) << "side " << side;
    }
    const Vec3 along = normalised(cross(n.to_float(), Vec3{0.3f, 0.8f, 0.52f}));
    const ExplosionSums edge_on = measure_explosion(shell, {middle + distance * along, reach, 50}, {});
    EXPECT_LT(edge_on.size, 1e-2 * 50 * 0.36 * length(area));
    EXPECT_EQ(measure_explosion(shell, {middle + 200.0f * n.to_float(), reach, 50}, {}).size, 0);
}

TEST(Explosion, ABallFarAwayGetsTwoThirdsOfItsDiscAndACloseOneLess) {
    const double disc = 3.14159265 * 0.1 * 0.1;
    EXPECT_NEAR(impulse_on_ball(1000, 0.1, 1e5f, 30), 30 * 0.99 * 0.99 * 2 / 3 * disc, 3e-3 * 30 * disc);
    EXPECT_EQ(impulse_on_ball(0.05, 0.1, 1, 30), 0) << "inside of it";
    EXPECT_EQ(impulse_on_ball(0, 0.1, 1, 30), 0);
    EXPECT_LT(impulse_on_ball(0.15, 0.1, 1e5f, 30), impulse_on_ball(10, 0.1, 1e5f, 30));
}

TEST(Explosion, FarWallsAreShadedAndFromInsideAllWallsAreLit) {
    World world = make_world(small_settings());
    const BodyId vase = add_vase(world);
    const State& state = state_of(world);
    const ShellView shell(state_of(world), state.bodies.structure[vase.index]);
    const Vec3 middle = state.bodies.centre[vase.index].to_float();
    for (const float distance : {0.3f, 2.0f}) {
        const ExplosionSums outside = measure_explosion(shell, {middle + Vec3{0, 0, distance}, 10, 10}, {});
        // Seen from afar half of the walls are lit, all pushed away: what is pushed sideways cancels.
        EXPECT_LT(outside.impulse.z, -0.5 * outside.size) << distance;
        EXPECT_LT(outside.place.z, double{middle.z} + 0.08) << distance;
        EXPECT_GT(outside.place.z, double{middle.z}) << "the near wall, distance " << distance;
    }
    const ExplosionSums inside = measure_explosion(shell, {middle, 10, 10}, {});
    const ExplosionSums outside = measure_explosion(shell, {middle + Vec3{0, 0, 2}, 10, 10}, {});
    EXPECT_GT(inside.size, 1.5 * outside.size);
    EXPECT_LT(length(inside.impulse), 0.5 * inside.size) << "it pushes to all sides";
}

TEST(Explosion, NearAVaseItBreaksItAndTheBooksOfMomentumAgree) {
    World world = make_world(small_settings());
    const BodyId vase = add_vase(world);
    const BodyId ball = world.add_sphere(ball_at({0.4f, 0.15f, 0}, 1, 0)).value();
    const Vec3 ball_place = world.pose(ball)->position;
    const Vec3 middle = state_of(world).bodies.centre[vase.index].to_float();
    ExplosionSettings e;
    e.centre = middle + Vec3{0, 0, 0.15f};
    e.radius = 2;
    e.pressure = 1'000'000;
    e.seconds = 2e-4f;
    ASSERT_TRUE(world.explode(e).ok());
    for (int frame = 0; frame < 40; ++frame) {
        world.step();
        if (frame == 0) {
            const double distance = length(Vec3d(ball_place - e.centre));
            const Vec3 velocity = world.motion(ball)->velocity;
            EXPECT_NEAR(length(velocity), impulse_on_ball(distance, 0.03, 2, 200), 1e-5);
            EXPECT_GT(dot(velocity, ball_place - e.centre), 0);
        }
    }
    EXPECT_GT(world.contents().data.counts.broke, 0u);
    EXPECT_LT(length(momentum_of(world) + given_of(world)), 2e-4 * length(given_of(world)));
    EXPECT_EQ(state_of(world).blows.size(), 0u);
}

// A host refuses more than 100,000 m/s: its own rows must not come to it.
TEST(Explosion, NoneMakesABodyFasterThanTheRigidWorldTakes) {
    for (const bool is_breakable : {false, true}) {
        World world = std::move(World::create_hosted(small_settings())).value();
        SpawnSettings settings;
        settings.is_breakable = is_breakable;
        const BodyId pane = world.spawn(world.add_model(small_pane()).value(), settings).value();
        const HostBody row{pane, {}, {}};
        ASSERT_TRUE(world.step({&row, 1, nullptr, 0}).ok());
        ExplosionSettings e;
        e.centre = {0.05f, 0.2f, 0.1f};
        e.impulse = 1e9f;
        ASSERT_TRUE(world.explode(e).ok());
        float fastest = 0;
        for (int frame = 0; frame < 10; ++frame) {
            ASSERT_TRUE(world.step({nullptr, 0, nullptr, 0}).ok());
            for (const BodyId id : shells_of(world)) {
                const Motion m = world.motion(id).value();
                for (const Vec3 v : {m.velocity, m.angular_velocity})
                    fastest = std::max({fastest, std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
            }
        }
        EXPECT_LE(fastest, 1e5f);
        EXPECT_GT(fastest, 1e4f);
        EXPECT_GT(world.contents().data.counts.clamped, 0u);
    }
}

TEST(Explosion, AHarmlessOneGivesTheWholeBodyTheSum) {
    World world = make_world(small_settings());
    const BodyId vase = add_vase(world);
    const State& state = state_of(world);
    ExplosionSettings e;
    e.centre = {0.3f, 0.1f, 0.2f};
    e.impulse = 0.05f;
    const ExplosionSums sums = measure_explosion(ShellView(state_of(world), state.bodies.structure[vase.index]),
                                                 {e.centre, e.radius, e.impulse}, state.bodies.centre[vase.index]);
    ASSERT_TRUE(world.explode(e).ok());
    Vec3d spin;
    after_each_system(world, [&](const std::string& system) {  // the solver damps spins by 0.2 % a step
        if (system == "open_tasks") spin = Vec3d(world.motion(vase)->angular_velocity);
    });
    world.step();
    EXPECT_EQ(world.contents().data.counts.opened, 0u);
    EXPECT_GT(length(sums.impulse), 0);
    EXPECT_LT(length(momentum_of(world) - sums.impulse), 1e-5 * length(sums.impulse));
    const Vec3d wanted = inverse(state.bodies.inertia[vase.index]) * sums.turning;
    EXPECT_LT(length(spin - wanted), 1e-4 * length(wanted));
}

}  // namespace
}  // namespace cullet::test
