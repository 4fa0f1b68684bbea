#include "sample_game/meshes.hpp"
#include "sample_game/scenes/scenes.hpp"

namespace cullet {
namespace {

Keys wall_keys() {
    Keys keys = common_keys("brick", 0.1, 0.078);
    keys.number("scene.speed_mps", "m/s", 10, 0, 100, "of the ball")
        .number("scene.mass_kg", "kg", 30, 0.01, 1e5, "of the ball");
    return keys;
}

/// 2.4 x 1.8 m of brick whose lowest row is held by the ground; the ball comes from the front, at least 0.4 m from the
/// edges.
Result<ScenePlan> wall_plan(const SceneInput& input) {
    const Keys& keys = input.keys;
    ScenePlan plan = begin_plan(input);
    const auto edge = static_cast<float>(keys["scene.edge_m"]);
    if (auto cooked = cook_into(plan, input, make_wall(2.4f, 1.8f, edge, plan.seed)); !cooked.ok())
        return Error{cooked.error()};
    plan.props.push_back(floor_prop());

    const float thickness = static_cast<float>(keys["scene.thickness_m"]);
    Spawn wall;
    wall.settings.user_data = 1;
    wall.settings.strength_scale = static_cast<float>(keys["scene.strength_scale"]);
    wall.settings.pose.position = {0, 0.002f, 0};
    wall.pins.push_back({{-2, -0.01f, -2 * thickness}, {2, 0.25f * edge, 2 * thickness}});
    plan.spawns.push_back(wall);

    SphereSettings ball;
    ball.radius = 0.14f;
    ball.mass = static_cast<float>(keys["scene.mass_kg"]);
    ball.pose.position = {static_cast<float>(0.5 * seeded(keys, 1)), static_cast<float>(0.95 + 0.3 * seeded(keys, 2)),
                          1.5f};
    // At 10 m/s it flies level when it arrives.
    ball.motion.velocity = {0, 1.2f, -static_cast<float>(keys["scene.speed_mps"])};
    plan.balls.push_back(ball);
    plan.camera = {{1.9f, 1.5f, 3.0f}, {-0.05f, 0.75f, -0.1f}, 0.72f};
    return plan;
}

constexpr uint32_t kSheet[] = {0, 8, 10, 12, 15, 18, 24, 32, 45, 70, 140, 599};

}  // namespace

const Scene kWallScene{"wall",   "a ball of 30 kg goes through a brick wall whose foot is held", 600, kSheet, wall_keys,
                       wall_plan};

}  // namespace cullet
