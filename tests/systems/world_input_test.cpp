// Bad input through every call of the public face: one sentence each, and the world goes on.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sample_game/meshes.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

template <class T>
void expect_refused(const Result<T>& result, const std::string& part) {
    ASSERT_FALSE(result.ok()) << "accepted; should have spoken of " << part;
    EXPECT_NE(result.error().find(part), std::string::npos) << result.error();
    ASSERT_GT(result.error().size(), 20u) << result.error();
    EXPECT_EQ(result.error().back(), '.') << result.error();
    EXPECT_EQ(result.error().find('\n'), std::string::npos) << result.error();
}

TEST(WorldInput, SettingsOutOfRangeAreNamed) {
    const auto refused = [](auto change, const char* part) {
        Settings settings = small_settings();
        change(settings);
        expect_refused(World::create(settings), part);
    };
    refused([](Settings& s) { s.step_seconds = 0; }, "step_seconds");
    refused([](Settings& s) { s.step_seconds = kNan; }, "step_seconds");
    refused([](Settings& s) { s.step_seconds = 1; }, "step_seconds");
    refused([](Settings& s) { s.gravity = {0, kNan, 0}; }, "gravity");
    refused([](Settings& s) { s.gravity = {0, kInf, 0}; }, "gravity");
    refused([](Settings& s) { s.units_a_frame = 0; }, "units_a_frame");
    refused([](Settings& s) { s.units_a_frame = ~0ull; }, "units_a_frame");
    refused([](Settings& s) { s.hold_seconds = -1; }, "hold_seconds");
    refused([](Settings& s) { s.hold_seconds = kNan; }, "hold_seconds");
    refused([](Settings& s) { s.threads = 0; }, "threads");
    refused([](Settings& s) { s.generations = 1000; }, "generations");
    refused([](Settings& s) { s.debris_share = -0.1f; }, "debris_share");
    refused([](Settings& s) { s.debris_share = kNan; }, "debris_share");
    refused([](Settings& s) { s.limits.bodies = 0; }, "limits.bodies");
    refused([](Settings& s) { s.limits.models = 0xffffffffu; }, "limits.models");
    refused([](Settings& s) { s.limits.vertices = 1; }, "limits.vertices");
    refused([](Settings& s) { s.limits.elements = 0xffffffffu; }, "limits.elements");
    refused([](Settings& s) { s.limits.open_hits = 0; }, "limits.open_hits");
    refused([](Settings& s) { s.limits.view_vertices = 3; }, "limits.view_vertices");
    refused([](Settings& s) { s.limits.debris = 0; }, "limits.debris");
}

TEST(WorldInput, HalfAHostIsRefused) {
    Host host;
    host.allocator.release = [](void*, void*, size_t) {};
    expect_refused(World::create(small_settings(), host), "allocator");
    host = {};
    host.jobs.parallel_for = [](void*, uint32_t, void (*)(void*, uint32_t), void*) {};
    expect_refused(World::create(small_settings(), host), "jobs");
}

TEST(WorldInput, MeshesThatCannotBeCookedAreRefused) {
    const Mesh good = make_pane(0.3f, 0.1f);
    const auto refused = [&](auto change, const char* part) {
        Mesh mesh = good;
        CookSettings settings;
        MeshView view;
        change(mesh, settings);
        view = view_of_mesh(mesh);
        settings.thick_shell.measures_threshold = false;
        expect_refused(cook(view, settings), part);
    };
    refused([](Mesh&, CookSettings& s) { s.thickness = 0; }, "thickness");
    refused([](Mesh&, CookSettings& s) { s.thickness = -1; }, "thickness");
    refused([](Mesh&, CookSettings& s) { s.thickness = kNan; }, "thickness");
    refused([](Mesh&, CookSettings& s) { s.thickness = 1; }, "diagonal");
    refused([](Mesh&, CookSettings& s) { s.material = "cheese"; }, "cheese");
    refused([](Mesh&, CookSettings& s) { s.longest_edge = kNan; }, "longest_edge");
    refused([](Mesh&, CookSettings& s) { s.longest_edge = -1; }, "longest_edge");
    refused([](Mesh& m, CookSettings&) { m.triangles[3][1] = 100000; }, "triangle 3");
    refused([](Mesh& m, CookSettings&) { m.positions[2].y = kNan; }, "vertex 2");
    refused([](Mesh& m, CookSettings&) { m.positions[2].y = kInf; }, "vertex 2");
    refused([](Mesh& m, CookSettings&) { m.triangles.clear(); }, "triangle");
    refused([](Mesh& m, CookSettings&) { m.positions.clear(); }, "");
    refused(
        [](Mesh& m, CookSettings&) {
            for (Vec3& p : m.positions) p = {1, 2, 3};
        },
        "");
    refused(
        [](Mesh& m, CookSettings&) {
            for (Vec3& p : m.positions) p = {p.x, 0, 0};
        },
        "on a line");
    refused(
        [](Mesh& m, CookSettings& s) {
            for (Vec3& p : m.positions) p.y *= 1e-7f;
            s.thickness = 0.001f, s.longest_edge = 1;
        },
        "far too short for its size");
    expect_refused(cook({}, {}), "triangles");
}

TEST(WorldInput, EveryTriangleIsCookedOrRefusedWithoutHarm) {
    // One triangle alone is a shell; two that only touch in a point are not held together.
    const Vec3 points[] = {{0, 0, 0}, {0.1f, 0, 0}, {0, 0.1f, 0}, {-0.1f, 0, 0}, {0, -0.1f, 0}};
    const uint32_t one[] = {0, 1, 2}, bow[] = {0, 1, 2, 0, 3, 4};
    CookSettings settings;
    settings.thick_shell.measures_threshold = false;
    settings.longest_edge = 10;
    const Result<Model> single = cook({points, 5, one, 1}, settings);
    EXPECT_TRUE(single.ok() || single.error().size() > 20) << single.error();
    const Result<Model> pair = cook({points, 5, bow, 2}, settings);
    EXPECT_TRUE(pair.ok() || pair.error().size() > 20) << pair.error();
}

TEST(WorldInput, AnEmptyModelHasAnEmptyReportAndIsRefused) {
    World world = make_world(small_settings());
    const Model model;
    EXPECT_EQ(model.report().vertices, 0u);
    expect_refused(world.add_model(model), "model");
}

TEST(WorldInput, FilesThatAreNotThereAreRefused) {
    expect_refused(read_mesh("/nowhere/at.cmesh"), "/nowhere/at.cmesh");
}

TEST(WorldInput, BodiesWithBadNumbersAreRefusedByName) {
    World world = make_world(small_settings());
    const ModelId model = world.add_model(small_pane()).value();
    const uint32_t before = world.bodies(nullptr, 0);
    const auto spawn = [&](auto change, const char* part) {
        SpawnSettings s;
        change(s);
        expect_refused(world.spawn(model, s), part);
    };
    spawn([](SpawnSettings& s) { s.pose.position.x = kNan; }, "position");
    spawn([](SpawnSettings& s) { s.pose.position.x = 1e30f; }, "position");
    spawn([](SpawnSettings& s) { s.pose.orientation = {0, 0, 0, 0}; }, "orientation");
    spawn([](SpawnSettings& s) { s.pose.orientation = {0, 0, 0, kNan}; }, "orientation");
    spawn([](SpawnSettings& s) { s.motion.velocity.z = kInf; }, "velocity");
    spawn([](SpawnSettings& s) { s.motion.angular_velocity.z = kNan; }, "angular_velocity");
    spawn([](SpawnSettings& s) { s.strength_scale = 0; }, "strength_scale");
    spawn([](SpawnSettings& s) { s.strength_scale = -1; }, "strength_scale");
    spawn([](SpawnSettings& s) { s.strength_scale = kNan; }, "strength_scale");
    spawn([](SpawnSettings& s) { s.contact.friction = kNan; }, "friction");
    spawn([](SpawnSettings& s) { s.contact.restitution = 3; }, "restitution");
    spawn([](SpawnSettings& s) { s.pin_count = 2; }, "pins");
    const Box nowhere{{5, 5, 5}, {6, 6, 6}};
    spawn([&](SpawnSettings& s) { s.pins = &nowhere, s.pin_count = 1; }, "pin boxes");
    const Box nan{{kNan, kNan, kNan}, {kNan, kNan, kNan}};
    spawn([&](SpawnSettings& s) { s.pins = &nan, s.pin_count = 1; }, "pin boxes");
    const auto sphere = [&](auto change, const char* part) {
        SphereSettings s;
        change(s);
        expect_refused(world.add_sphere(s), part);
    };
    sphere([](SphereSettings& s) { s.radius = 0; }, "radius");
    sphere([](SphereSettings& s) { s.radius = kInf; }, "radius");
    sphere([](SphereSettings& s) { s.mass = kNan; }, "mass");
    sphere([](SphereSettings& s) { s.mass = kInf; }, "mass");
    sphere([](SphereSettings& s) { s.pose.position.y = kNan; }, "position");
    const auto box = [&](auto change, const char* part) {
        KinematicSettings s;
        change(s);
        expect_refused(world.add_kinematic_box(s), part);
    };
    box([](KinematicSettings& s) { s.half_extents.y = 0; }, "half_extents");
    box([](KinematicSettings& s) { s.half_extents.y = kNan; }, "half_extents");
    box([](KinematicSettings& s) { s.half_extents.y = kInf; }, "half_extents");
    box([](KinematicSettings& s) { s.motion.velocity.y = kNan; }, "velocity");
    const Vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, kNan}};
    const uint32_t past[] = {0, 1, 7}, nan_point[] = {0, 1, 2};
    expect_refused(world.add_static({points, 3, past, 1}), "vertex 7");
    expect_refused(world.add_static({points, 3, nan_point, 1}), "vertex 2");
    expect_refused(world.add_static({}), "triangles");
    EXPECT_EQ(world.bodies(nullptr, 0), before);
    EXPECT_EQ(state_of(world).validate(), "");
    world.step();
}

TEST(WorldInput, StaleHandlesAreRefusedByEveryCall) {
    World world = make_world(small_settings());
    const ModelId model = world.add_model(small_pane()).value();
    const BodyId body = world.spawn(model).value();
    ASSERT_TRUE(world.remove(body).ok());
    const BodyId next = world.spawn(model).value();  // in the same row
    ASSERT_EQ(next.index, body.index);
    for (const BodyId stale : {body, BodyId{}, BodyId{100000, 1}, BodyId{next.index, next.generation + 1}}) {
        EXPECT_FALSE(world.is_alive(stale));
        expect_refused(world.remove(stale), "handle");
        expect_refused(world.pose(stale), "handle");
        expect_refused(world.motion(stale), "handle");
        expect_refused(world.mass(stale), "handle");
        expect_refused(world.user_data(stale), "handle");
        expect_refused(world.is_asleep(stale), "handle");
        expect_refused(world.set_pose(stale, {}), "handle");
        expect_refused(world.set_motion(stale, {}), "handle");
        expect_refused(world.apply_impulse(stale, {}, {}), "handle");
        expect_refused(world.wake(stale), "handle");
        expect_refused(world.view(stale), "handle");
    }
    EXPECT_TRUE(world.is_alive(next));
    ASSERT_TRUE(world.remove_model(model).ok());
    expect_refused(world.remove_model(model), "handle");
    expect_refused(world.remove_model({}), "handle");
    expect_refused(world.spawn(model), "handle");
    EXPECT_TRUE(world.view(next).ok());  // bodies outlive their model
}

TEST(WorldInput, BadNumbersForALiveBodyAreRefusedAndChangeNothing) {
    World world = make_world(small_settings());
    const BodyId ball = world.add_sphere({}).value();
    const BodyId floor = add_floor(world);
    const uint64_t before = world.hash();
    expect_refused(world.set_pose(ball, {{kNan, 0, 0}, {}}), "position");
    expect_refused(world.set_pose(ball, {{}, {1, 1, 1, 1}}), "orientation");
    expect_refused(world.set_motion(ball, {{kInf, 0, 0}, {}}), "velocity");
    expect_refused(world.apply_impulse(ball, {kNan, 0, 0}, {}), "impulse");
    expect_refused(world.apply_impulse(ball, {1e38f, 0, 0}, {}), "velocity");
    expect_refused(world.set_motion(floor, {{1, 0, 0}, {}}), "static");
    expect_refused(world.set_pose(floor, {{1, 0, 0}, {}}), "static");
    EXPECT_EQ(world.hash(), before);
}

TEST(WorldInput, AHostsFrameIsRefusedWhereBulletMovesTheBodies) {
    World world = make_world(small_settings());
    EXPECT_NE(world.step(HostFrame{}).error().find("create_hosted"), std::string::npos);
    EXPECT_EQ(world.report().frame, 0u);
    EXPECT_EQ(world.host_changes().born.count, 0u);
}

}  // namespace
}  // namespace cullet::test
