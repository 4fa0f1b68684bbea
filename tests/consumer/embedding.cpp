// The code of docs/embedding.md, built and run.
#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "cullet/debug.hpp"
#include "cullet/query.hpp"
#include "cullet/world.hpp"

using namespace cullet;

struct Game {
    World world;
    double unsimulated = 0;
    uint32_t sounds = 0, particles = 0, drawn = 0;

    void play_sound(Vec3, double) { ++sounds; }
    void add_particle(Vec3, Vec3) { ++particles; }
    void upload(BodyId, const ViewVertex*, uint32_t, const uint32_t*, uint32_t) {}
    void draw(BodyId, const Pose&, const Pose&, float) { ++drawn; }

    void frame(double seconds);
    void react();
    void draw_all(std::vector<uint32_t>& stamps);
    BodyId aim(Vec3 eye, Vec3 way);
    void throw_away(Vec3 at);
    void strike(BodyId body, Vec3 at);
    void show_lines();
    void follow(Vec3& player);
    Result<void> quick_save(const std::string& path);
};

void Game::frame(double seconds) {
    for (unsimulated += seconds; unsimulated >= 1.0 / 60; unsimulated -= 1.0 / 60) {
        world.step();  // Settings::step_seconds, always the same
        react();
    }
}

void Game::react() {
    for (const ImpactEvent& e : world.events().impacts) play_sound(e.place, e.energy);
    for (const DebrisEvent& e : world.events().debris) add_particle(e.place, e.velocity);
    for (const RefusedEvent& e : world.events().refused) std::printf("limit reached: %s\n", e.setting);
}

void Game::draw_all(std::vector<uint32_t>& stamps) {
    BodyId bodies[256];
    const uint32_t count = std::min(world.bodies(bodies, 256), 256u);
    for (uint32_t i = 0; i < count; ++i) {
        const BodyView view = world.view(bodies[i]).value();
        if (view.index_count == 0) continue;  // a ball, a floor: the game's own
        if (stamps.size() <= bodies[i].index) stamps.resize(bodies[i].index + 1);
        if (stamps[bodies[i].index] != view.stamp)
            upload(bodies[i], view.vertices, view.vertex_count, view.indices, view.index_count);
        stamps[bodies[i].index] = view.stamp;
        draw(bodies[i], view.pose_before, view.pose, static_cast<float>(60 * unsimulated));
    }
}

BodyId Game::aim(Vec3 eye, Vec3 way) {
    const SurfaceHit hit = ray(world, eye, way, 100);
    if (hit) std::printf("%.1f m away, triangle %u\n", hit.distance, hit.triangle);
    return hit.body;
}

void Game::throw_away(Vec3 at) {
    BodyId near[64];
    const uint32_t count = std::min(overlap(world, at, 3, near, 64), 64u);
    for (uint32_t i = 0; i < count; ++i) {
        const Vec3 p = world.pose(near[i]).value().position;
        (void)world.apply_impulse(near[i], {p.x - at.x, p.y - at.y, p.z - at.z}, p);
    }
}

void Game::strike(BodyId body, Vec3 at) {
    PushSettings hammer{.place = at, .normal = {0, -1, 0}, .approach_speed = 6, .mass = 0.5f, .radius = 0.015f};
    if (const Result<void> done = world.push_impact(body, hammer); !done) std::puts(done.error().c_str());
    (void)world.explode({.centre = at, .radius = 2, .pressure = 4e5f, .seconds = 2e-4f});
    const Vec3 line[] = {{at.x - 1, at.y, at.z}, {at.x, at.y + 0.05f, at.z}, {at.x + 1, at.y, at.z}};
    (void)world.cut({}, {.points = line, .point_count = 3, .direction = {0, 0, 1}});  // all that it passes through
}

void Game::show_lines() {
    const auto line = [](void* user, Vec3, Vec3, uint32_t) { ++*static_cast<uint32_t*>(user); };
    draw_debug(world, kDebugBounds | kDebugContacts | kDebugCracks, line, &drawn);
}

void Game::follow(Vec3& player) {
    if (player.x * player.x + player.z * player.z < 1e6f) return;
    const Vec3 by{256 * static_cast<float>(static_cast<int>(player.x / 256)), 0,
                  256 * static_cast<float>(static_cast<int>(player.z / 256))};
    if (world.shift_origin(by).ok()) player = {player.x - by.x, player.y, player.z - by.z};
}

Result<void> Game::quick_save(const std::string& path) {
    if (Result<void> saved = world.save(path); !saved) return saved;
    return world.start_recording(path + ".crec");  // what is asked from here on, and a hash after each step
}

int main() {
    Settings settings;
    settings.limits.bodies = 512;
    Result<World> made = World::create(settings);
    if (!made.ok()) return std::fprintf(stderr, "%s\n", made.error().c_str()), 1;
    Game game{std::move(made).value()};
    // A tetrahedron's shell, thrown on the floor far away.
    const Vec3 points[] = {{0, 0, 0}, {0.2f, 0, 0}, {0, 0.2f, 0}, {0, 0, 0.2f}};
    const uint32_t faces[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const Result<Model> model = cook({points, 4, faces, 4}, {});
    if (!model.ok()) return std::fprintf(stderr, "%s\n", model.error().c_str()), 1;
    Vec3 player{3000, 0, 0};
    const Vec3 corners[] = {{2990, 0, -9}, {2990, 0, 9}, {3010, 0, 9}, {3010, 0, -9}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    (void)game.world.add_static({corners, 4, quad, 2}).value();
    SpawnSettings spawn;
    spawn.pose.position = {3000, 1, 0};
    spawn.motion.velocity = {0, -12, 0};
    const BodyId body = game.world.spawn(game.world.add_model(model.value()).value(), spawn).value();
    game.follow(player);
    const bool is_saved = game.quick_save("embedding.csnap").ok();
    std::vector<uint32_t> stamps;
    const bool is_seen = game.aim({player.x, 5, player.z}, {0.01f, -1, 0.01f}) == body;
    for (int frame = 0; frame < 90; ++frame) {
        game.frame(1.0 / 90);
        game.draw_all(stamps);
    }
    game.throw_away(player);
    game.strike(body, game.world.pose(body).value().position);
    game.frame(1.0 / 30);
    game.show_lines();
    const bool is_recorded = game.world.stop_recording().ok();
    for (const char* file : {"embedding.csnap", "embedding.csnap.crec"}) std::remove(file);
    return is_saved && is_recorded && is_seen && game.sounds > 0 && game.drawn > 90 ? 0 : 1;
}
