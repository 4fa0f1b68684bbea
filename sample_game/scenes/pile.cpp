#include <algorithm>

#include "engine/math.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/scenes/scenes.hpp"

namespace cullet {
namespace {

constexpr uint32_t kFramesBetween = 14, kMostVases = 120;
constexpr Vec3 kStone{0.33f, 0.32f, 0.30f};

Keys pile_keys() {
    Keys keys = common_keys("porcelain", 0.005, 0.012);
    keys.number("scene.count", "1", 1000, 1, 4000, "live fragments after which no more vases fall")
        .number("scene.speed_mps", "m/s", 12, 0, 50, "downward at the start")
        .number("scene.height_m", "m", 1.6, 0.1, 20, "of the fall")
        .number("scene.size_m", "m", 0.3, 0.05, 3, "height of a vase");
    return keys;
}

/// Four vases at a time are thrown into a pit of stone, turned in all ways, until enough fragments live; then they
/// come to rest. Nothing is made beforehand: every fragment was broken here.
Result<ScenePlan> pile_plan(const SceneInput& input) {
    const Keys& keys = input.keys;
    ScenePlan plan = begin_plan(input);
    const auto size = static_cast<float>(keys["scene.size_m"]), edge = static_cast<float>(keys["scene.edge_m"]);
    if (auto cooked = cook_into(plan, input, make_vase(size, edge, plan.seed)); !cooked.ok())
        return Error{cooked.error()};
    plan.props.push_back(floor_prop());
    // Walls go down into the ground: standing on it they would press into it what is a millimetre deep in both.
    const float half = 0.8f, wall = 0.1f, high = 0.5f, low = -0.5f;
    plan.props.push_back(box_prop({-half - wall, low, -half - wall}, {half + wall, high, -half}, kStone));
    plan.props.push_back(box_prop({-half - wall, low, -half}, {-half, high, half}, kStone));
    plan.props.push_back(box_prop({half, low, -half}, {half + wall, high, half}, kStone));
    plan.props.push_back(box_prop({-half - wall, low, half}, {half + wall, high, half + wall}, kStone));

    plan.settings.limits.open_hits = 512;  // shards meet shards all over the pit
    // Dozens of hits a frame: at the default they would all be late, and vases would bounce whole.
    plan.settings.units_a_frame = std::max<uint64_t>(plan.settings.units_a_frame, 100'000'000);
    for (uint32_t v = 0; v < kMostVases; ++v) {
        const uint32_t number = 10 * (v + 1), corner = v % 4;
        Spawn vase;
        vase.frame = uint64_t{v / 4} * kFramesBetween;
        vase.settings.user_data = 1;
        vase.settings.strength_scale = static_cast<float>(keys["scene.strength_scale"]);
        vase.settings.pose.orientation = any_turn(keys, number);
        const Vec3 middle{(corner & 1 ? 0.38f : -0.38f) + static_cast<float>(0.12 * seeded(keys, number + 3)),
                          static_cast<float>(keys["scene.height_m"]) + 0.5f * size,
                          (corner & 2 ? 0.38f : -0.38f) + static_cast<float>(0.12 * seeded(keys, number + 4))};
        vase.settings.pose.position = middle - rotate(vase.settings.pose.orientation, {0, 0.5f * size, 0});
        vase.settings.motion.velocity = {0, -static_cast<float>(keys["scene.speed_mps"]), 0};
        plan.spawns.push_back(vase);
    }
    plan.fragments_wanted = static_cast<uint32_t>(keys["scene.count"]);
    plan.camera = {{1.5f, 1.75f, 2.1f}, {0, 0.15f, 0}, 0.72f};
    return plan;
}

constexpr uint32_t kSheet[] = {4, 12, 24, 48, 96, 150, 220, 320, 450, 600, 800, 1199};

}  // namespace

const Scene kPileScene{"pile",    "vases are thrown into a pit until 1,000 fragments live, which come to rest",
                       1200,      kSheet,
                       pile_keys, pile_plan};

}  // namespace cullet
