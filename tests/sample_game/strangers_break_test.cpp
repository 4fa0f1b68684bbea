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
#include "sample_game/props.hpp"
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

/// Porcelain, 2 % of the diagonal thick, edges of at most 5 %.
Result<Model> cooked(const Mesh& mesh) {
    const auto diagonal = static_cast<float>(diagonal_of(mesh));
    CookSettings settings;
    settings.thickness = 0.02f * diagonal;
    settings.longest_edge = 0.05f * diagonal;
    settings.thick_shell.measures_threshold = false;
    return cook(view_of(mesh), settings);
}

struct Broken {
    uint64_t pieces = 0, faults = 0;
    double mass_error = 0;  // share of the mass put in
};

/// Over a floor that it meets in the first frames.
Result<Broken> break_it(const Mesh& mesh, const Model& model) {
    const auto diagonal = static_cast<float>(diagonal_of(mesh));
    // A hit is over in the frame of its touch.
    Settings settings;
    settings.threads = 2;
    settings.units_a_frame = 2'000'000'000'000;
    Result<World> made = World::create(settings);
    if (!made.ok()) return Error{made.error()};
    World& world = *made;
    const Result<BodyId> floor = world.add_static(view_of(floor_prop(std::max(30.0f, 20 * diagonal)).mesh));
    if (!floor.ok()) return Error{floor.error()};
    SpawnSettings body;
    body.pose.orientation = turn({0.3f, 0.2f, 1}, 0.5);
    float lowest = 1e30f;
    for (const Vec3 p : mesh.positions) lowest = std::min(lowest, rotate(body.pose.orientation, p).y);
    body.pose.position = {0, 0.01f * diagonal + 0.05f - lowest, 0};
    body.motion.velocity = {0, -kSpeed, 0};
    const Result<ModelId> id = world.add_model(model);
    if (!id.ok()) return Error{id.error()};
    if (const auto spawned = world.spawn(*id, body); !spawned.ok()) return Error{spawned.error()};
    Broken broken;
    const double put_in = measure_matter(world).mass;
    for (int left = kMostFrames; left > 0; --left) {
        world.step();
        broken.pieces += world.events().fragments_born.count;
        broken.faults += world.events().faults.count;
        if (broken.pieces > 0) left = std::min(left, kFramesAfter);
    }
    broken.mass_error = (measure_matter(world).mass - put_in) / put_in;
    return broken;
}

void expect_breaks(const fs::path& file) {
    const auto begin = std::chrono::steady_clock::now();
    const Result<Mesh> mesh = import_model(file);
    ASSERT_TRUE(mesh.ok()) << mesh.error();
    const Result<Model> model = cooked(*mesh);
    ASSERT_TRUE(model.ok()) << model.error();
    const Result<Broken> broken = break_it(*mesh, *model);
    ASSERT_TRUE(broken.ok()) << broken.error();
    EXPECT_GT(broken->pieces, 0u) << file;
    EXPECT_EQ(broken->faults, 0u) << file;
    EXPECT_LE(std::fabs(broken->mass_error), 1e-6) << file;
    std::printf("| %s | %zu | %u | %llu | %.1e | %.1f |\n", file.filename().c_str(), mesh->positions.size(),
                model->report().vertices, static_cast<unsigned long long>(broken->pieces), broken->mass_error,
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
