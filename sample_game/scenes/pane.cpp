#include "sample_game/meshes.hpp"
#include "sample_game/scenes/scenes.hpp"

namespace cullet {
namespace {

constexpr float kSide = 0.5f, kFoot = 0.35f;  // m; the pane's lower border stands at kFoot
constexpr Vec3 kFrame{0.16f, 0.17f, 0.18f};

Keys pane_keys() {
    Keys keys = common_keys("glass", 0.004, 0.010);
    keys.number("scene.speed_mps", "m/s", 8, 0, 100, "of the ball")
        .number("scene.mass_kg", "kg", 0.1, 0.001, 100, "of the ball");
    return keys;
}

/// Four beams round the pane with 2 mm of room, the lower one on two posts.
void add_frame(ScenePlan& plan) {
    const float half = 0.5f * kSide + 0.002f, beam = 0.03f, depth = 0.02f, low = kFoot - 0.002f, high = low + 2 * half;
    const auto add = [&](Vec3 a, Vec3 b) { plan.props.push_back(box_prop(a, b, kFrame)); };
    add({-half - beam, low - beam, -depth}, {half + beam, low, depth});
    add({-half - beam, high, -depth}, {half + beam, high + beam, depth});
    add({-half - beam, low, -depth}, {-half, high, depth});
    add({half, low, -depth}, {half + beam, high, depth});
    add({-half - beam, 0, -depth}, {-half, low - beam, depth});
    add({half, 0, -depth}, {half + beam, low - beam, depth});
}

/// Glass held along its whole border; the ball meets it at least 0.1 m from the frame.
Result<ScenePlan> pane_plan(const SceneInput& input) {
    const Keys& keys = input.keys;
    ScenePlan plan = begin_plan(input);
    const auto edge = static_cast<float>(keys["scene.edge_m"]);
    if (auto cooked = cook_into(plan, input, make_pane(kSide, edge, plan.seed)); !cooked.ok())
        return Error{cooked.error()};
    plan.props.push_back(floor_prop());
    add_frame(plan);

    Spawn pane;
    pane.settings.user_data = 1;
    pane.settings.strength_scale = static_cast<float>(keys["scene.strength_scale"]);
    pane.settings.pose.position = {0, kFoot, 0};
    const float half = 0.5f * kSide, rim = 0.25f * edge, out = 0.01f;
    pane.pins = {{{-half - out, -out, -out}, {half + out, rim, out}},
                 {{-half - out, kSide - rim, -out}, {half + out, kSide + out, out}},
                 {{-half - out, -out, -out}, {-half + rim, kSide + out, out}},
                 {{half - rim, -out, -out}, {half + out, kSide + out, out}}};
    plan.spawns.push_back(pane);

    SphereSettings ball;
    ball.radius = 0.0145f;
    ball.mass = static_cast<float>(keys["scene.mass_kg"]);
    ball.pose.position = {static_cast<float>(0.15 * seeded(keys, 1)),
                          kFoot + 0.5f * kSide + static_cast<float>(0.15 * seeded(keys, 2)), 0.8f};
    ball.motion.velocity = {0, 0, -static_cast<float>(keys["scene.speed_mps"])};
    plan.balls.push_back(ball);
    plan.camera = {{0.42f, 0.72f, 0.92f}, {0, 0.48f, 0}, 0.72f};
    return plan;
}

constexpr uint32_t kSheet[] = {0, 5, 7, 9, 11, 13, 16, 20, 26, 35, 60, 599};

}  // namespace

const Scene kPaneScene{"pane",   "a steel ball of 100 g goes through a framed window pane", 600, kSheet, pane_keys,
                       pane_plan};

}  // namespace cullet
