#include "tests/support/small_worlds.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "components/state.hpp"
#include "sample_game/meshes.hpp"

namespace cullet::test {
namespace {

Model cooked(const Mesh& mesh, const char* material, float thickness) {
    CookSettings settings;
    settings.material = material;
    settings.thickness = thickness;
    settings.longest_edge = 100;
    Result<Model> model = cook(view_of_mesh(mesh), settings);
    if (!model) ADD_FAILURE() << model.error(), std::abort();
    return std::move(model).value();
}

BodyId spawned(World& world, const Model& model, const SpawnSettings& settings) {
    const Result<ModelId> id = world.add_model(model);
    if (!id) ADD_FAILURE() << id.error(), std::abort();
    const Result<BodyId> body = world.spawn(id.value(), settings);
    if (!body) ADD_FAILURE() << body.error(), std::abort();
    return body.value();
}

}  // namespace

const Model& small_vase() {
    static const Model model = cooked(make_vase(0.3f, 0.0125f), "porcelain", 0.005f);
    return model;
}
const Model& fine_vase() {
    static const Model model = cooked(make_vase(0.3f, 0.0075f), "porcelain", 0.005f);
    return model;
}
const Model& small_pane() {
    static const Model model = cooked(make_pane(0.3f, 0.025f), "glass", 0.004f);
    return model;
}
const Model& small_wall() {
    static const Model model = cooked(make_wall(1.2f, 0.9f, 0.1f), "brick", 0.1f);
    return model;
}

MeshView view_of_mesh(const Mesh& mesh) {
    MeshView view;
    view.positions = mesh.positions.data();
    view.position_count = mesh.positions.size();
    view.indices = mesh.triangles.empty() ? nullptr : mesh.triangles[0].data();
    view.triangle_count = mesh.triangles.size();
    view.name = mesh.name.c_str();
    return view;
}

Settings small_settings() {
    Settings settings;
    settings.gravity = {};
    settings.units_a_frame = 1'000'000'000;
    settings.frames_ahead = 0;  // hits open at their touch: foresee_test plays the others
    settings.limits = {512, 8, 1u << 16, 1u << 17, 8, 1u << 19, 512};
    return settings;
}

World make_world(const Settings& settings, const Host& host) {
    Result<World> world = World::create(settings, host);
    if (!world) ADD_FAILURE() << world.error(), std::abort();
    return std::move(world).value();
}

SphereSettings ball_at(Vec3 place, float mass, float speed, float radius) {
    SphereSettings ball;
    ball.radius = radius;
    ball.mass = mass;
    ball.pose.position = place + Vec3{0, 0, 0.2f + radius};
    ball.motion.velocity = {0, 0, -speed};
    ball.user_data = 99;
    return ball;
}

Breakage vase_and_ball(const Settings& settings, float speed, const Host& host, float mass, const Model& model) {
    Breakage b{make_world(settings, host), {}, {}};
    SpawnSettings vase;
    vase.user_data = 42;
    b.body = spawned(b.world, model, vase);
    b.ball = b.world.add_sphere(ball_at({0.01f, 0.13f, 0}, mass, speed)).value();
    return b;
}

World two_vases(const Settings& settings, float first_speed, float second_speed) {
    World world = make_world(settings);
    const ModelId model = world.add_model(small_vase()).value();
    SpawnSettings vase;
    vase.pose.position = {0, 0, 0.3f};
    vase.motion.velocity = {0, 0, -first_speed};
    (void)world.spawn(model, vase).value();
    vase.pose.position = {0.01f, 0.02f, -0.3f};
    vase.motion.velocity = {0, 0, second_speed};
    (void)world.spawn(model, vase).value();
    return world;
}

Breakage wall_and_ball(const Settings& settings, float speed, const Host& host) {
    Breakage b{make_world(settings, host), {}, {}};
    const Box foot{{-2, -0.01f, -1}, {2, 0.025f, 1}};
    SpawnSettings wall;
    wall.user_data = 43;
    wall.pins = &foot;
    wall.pin_count = 1;
    b.body = spawned(b.world, small_wall(), wall);
    b.ball = b.world.add_sphere(ball_at({0.1f, 0.5f, 0}, 20, speed, 0.12f)).value();
    return b;
}

Breakage pane_and_ball(const Settings& settings, float speed, const Host& host) {
    Breakage b{make_world(settings, host), {}, {}};
    const Box frame[] = {{{-1, -0.01f, -1}, {1, 0.005f, 1}},
                         {{-1, 0.295f, -1}, {1, 0.31f, 1}},
                         {{-1, -0.01f, -1}, {-0.145f, 0.31f, 1}},
                         {{0.145f, -0.01f, -1}, {1, 0.31f, 1}}};
    SpawnSettings pane;
    pane.user_data = 44;
    pane.pins = frame;
    pane.pin_count = 4;
    b.body = spawned(b.world, small_pane(), pane);
    b.ball = b.world.add_sphere(ball_at({0.02f, 0.16f, 0}, 0.1f, speed, 0.0145f)).value();
    return b;
}

BodyId add_floor(World& world) {
    const Vec3 corners[] = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    return world.add_static({corners, 4, quad, 2}).value();
}

State& state_of(World& world) {
    return world.contents().data.state;
}
Tasks& tasks_of(World& world) {
    return state_of(world).tasks;
}
uint32_t open_tasks(const World& world) {
    return world.report().open_hits;
}

void after_each_system(World& world, std::function<void(const std::string& system)> f) {
    world.contents().after_each_system = [f](const PlannedSystem<WorldData>& system) { f(system.name); };
}

void expect_valid_after_each_system(World& world) {
    World::Contents* contents = &world.contents();
    after_each_system(world, [contents, found = false](const std::string& system) mutable {
        const std::string wrong = found ? "" : contents->data.state.validate();
        if (wrong.empty()) return;
        found = true;
        ADD_FAILURE() << "after " << system << ", frame " << contents->data.step_info.frame << ": " << wrong;
    });
}

std::vector<BodyId> all_bodies(const World& world) {
    std::vector<BodyId> bodies(world.bodies(nullptr, 0));
    world.bodies(bodies.data(), static_cast<uint32_t>(bodies.size()));
    return bodies;
}

std::vector<BodyId> shells_of(const World& world) {
    std::vector<BodyId> found;
    for (const BodyId body : all_bodies(world))
        if (world.contents().data.state.bodies.structure[body.index].exists()) found.push_back(body);
    return found;
}

uint32_t step_until_born(World& world, uint32_t frames) {
    for (uint32_t frame = 1; frame <= frames; ++frame) {
        world.step();
        if (world.events().fragments_born.count) return frame;
    }
    return 0;
}

}  // namespace cullet::test
