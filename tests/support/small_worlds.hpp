// Worlds small enough to break in a test: coarse models cooked once a program, and what tests measure of a world.
#pragma once
#include <string>
#include <vector>

#include "components/state.hpp"
#include "cullet/world.hpp"
#include "engine/mesh.hpp"
#include "sample_game/game_world.hpp"
#include "systems/world_contents.hpp"

namespace cullet::test {

/// Porcelain, edge 12.5 mm, 1,150 vertices; glass, 0.3 m, edge 25 mm; brick, 1.2 x 0.9 m, edge 0.1 m.
const Model& small_vase();
/// So many vertices that all workers share its hits.
const Model& fine_vase();
const Model& small_pane();
const Model& small_wall();

MeshView view_of_mesh(const Mesh& mesh);

/// No gravity unless set, room for small things.
Settings small_settings();

/// World::create, which must succeed.
World make_world(const Settings& settings, const Host& host = {});

/// A ball of this mass on its way along -z, to hit (x, y, 0) in the first frames.
SphereSettings ball_at(Vec3 place, float mass, float speed, float radius = 0.03f);

struct Breakage {
    World world;
    BodyId body, ball;
};
/// A vase at rest in mid-air, hit on its belly by a ball of 0.3 kg.
Breakage vase_and_ball(const Settings& settings, float speed = 8, const Host& host = {}, float mass = 0.3f,
                       const Model& model = small_vase());
/// Two vases in mid-air that fly at each other along z, m/s each.
World two_vases(const Settings& settings, float first_speed, float second_speed);
/// A wall whose foot is pinned, hit by a ball of 20 kg.
Breakage wall_and_ball(const Settings& settings, float speed = 10, const Host& host = {});
/// A pane pinned along its border, hit by a ball of 0.1 kg.
Breakage pane_and_ball(const Settings& settings, float speed = 8, const Host& host = {});
/// Floor at y = 0.
BodyId add_floor(World& world);

Tasks& tasks_of(World& world);
State& state_of(World& world);
uint32_t open_tasks(const World& world);
/// Calls `f(name)` after each system of every step.
void after_each_system(World& world, std::function<void(const std::string& system)> f);
/// Fails the test at the first system after which some table holds a value that is not finite.
void expect_valid_after_each_system(World& world);

std::vector<BodyId> all_bodies(const World& world);
/// Bodies that have a shell.
std::vector<BodyId> shells_of(const World& world);
/// Mass, momentum and kinetic energy of what moves.
inline Matter matter_of(const World& world) {
    return measure_matter(world);
}

/// Steps until something is born or `frames` have passed; the frames it took, or 0.
uint32_t step_until_born(World& world, uint32_t frames);

}  // namespace cullet::test
