// Every mesh of the data folder, in its own size, cooked as a thick shell and thrown at a floor: it breaks and keeps
// its mass. A few by themselves; all with CULLET_ALL_DATA=1.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <set>

#include "cullet/world.hpp"
#include "engine/math.hpp"
#include "sample_game/game_world.hpp"
#include "sample_game/import_model.hpp"
#include "sample_game/scenes/scenes.hpp"
#include "tests/support/data_files.hpp"
#include "tests/support/test_data.hpp"

namespace cullet {
namespace {

namespace fs = std::filesystem;

/// Coarse, open, closed, of many parts, of a car and of a house, 0.2 to 360 m: what takes a few seconds each.
const std::set<std::string> kFew{"vase.glb",        "plate.glb", "husky.glb",        "spot_control_mesh.obj",
                                 "curtain.ply",     "ball.obj",  "banana.obj",       "truck_yellow.glb",
                                 "plate_holes.stl", "bowl.ply",  "cube_regions.obj", "wall_rocks.glb"};
constexpr float kSpeed = 25;  // m/s: far above the first crack of every one, also of stones in a wall
constexpr int kFramesAfter = 30, kMostFrames = 240;

double diagonal_of(const Mesh& mesh) {
    Vec3 low = mesh.positions[0], high = low;
    for (const Vec3 p : mesh.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return length(Vec3d(high) - Vec3d(low));
}

/// Porcelain, 2 % of the diagonal thick, edges of at most 5 %, over a floor that it meets in the first frames.
Result<ScenePlan> plan_of(const Mesh& mesh) {
    ScenePlan plan;
    const auto diagonal = static_cast<float>(diagonal_of(mesh));
    CookSettings settings;
    settings.thickness = 0.02f * diagonal;
    settings.longest_edge = 0.05f * diagonal;
    settings.measures_threshold = false;
    Result<Model> model = cook(view_of(mesh), settings);
    if (!model.ok()) return Error{model.error()};
    plan.models.push_back(std::move(model).value());
    plan.settings.units_a_frame = 2'000'000'000'000;  // a hit is over in the frame of its touch
    plan.settings.threads = 2;
    plan.props.push_back(floor_prop(std::max(30.0f, 20 * diagonal)));
    Spawn body;
    body.settings.pose.orientation = turn({0.3f, 0.2f, 1}, 0.5);
    float lowest = 1e30f;
    for (const Vec3 p : mesh.positions) lowest = std::min(lowest, rotate(body.settings.pose.orientation, p).y);
    body.settings.pose.position = {0, 0.01f * diagonal + 0.05f - lowest, 0};
    body.settings.motion.velocity = {0, -kSpeed, 0};
    plan.spawns.push_back(body);
    return plan;
}

struct Broken {
    uint64_t pieces = 0, faults = 0;
    double mass_error = 0;  // share of the mass put in
};

Result<Broken> break_it(const ScenePlan& plan) {
    Result<GameWorld> game = GameWorld::create(plan);
    if (!game.ok()) return Error{game.error()};
    int left = kMostFrames;
    for (; left > 0; --left) {
        game->before_step();
        game->step();
        game->after_step();
        if (game->born > 0) left = std::min(left, kFramesAfter);
    }
    const double put_in = game->mass_put_in();
    return Broken{game->born, game->events["fault"], (measure_matter(game->world()).mass - put_in) / put_in};
}

void expect_breaks(const fs::path& file) {
    const auto begin = std::chrono::steady_clock::now();
    const Result<Mesh> mesh = import_model(file);
    ASSERT_TRUE(mesh.ok()) << mesh.error();
    const Result<ScenePlan> plan = plan_of(*mesh);
    ASSERT_TRUE(plan.ok()) << plan.error();
    const Result<Broken> broken = break_it(*plan);
    ASSERT_TRUE(broken.ok()) << broken.error();
    EXPECT_GT(broken->pieces, 0u) << file;
    EXPECT_EQ(broken->faults, 0u) << file;
    EXPECT_LE(std::fabs(broken->mass_error), 1e-6) << file;
    std::printf("| %s | %zu | %u | %llu | %.1e | %.1f |\n", file.filename().c_str(), mesh->positions.size(),
                plan->models[0].report().vertices, static_cast<unsigned long long>(broken->pieces), broken->mass_error,
                std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    std::fflush(stdout);
}

TEST(StrangersBreak, EveryMeshThatIsNotHostileCooksBreaksAndKeepsItsMass) {
    CULLET_SKIP_WITHOUT_DATA();
    const bool all = std::getenv("CULLET_ALL_DATA") != nullptr;
    std::printf("| file | vertices | of the shell | pieces | mass error | s |\n|---|---:|---:|---:|---:|---:|\n");
    size_t seen = 0;
    for (const fs::path& file : test::files_below(test::test_data())) {
        if (file.parent_path().filename() == "hostile" || test::is_companion(file)) continue;
        if (!all && kFew.count(file.filename()) == 0) continue;
        expect_breaks(file);
        ++seen;
    }
    EXPECT_EQ(seen, all ? 39u : kFew.size());
}

}  // namespace
}  // namespace cullet
