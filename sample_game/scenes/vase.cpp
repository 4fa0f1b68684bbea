#include "engine/math.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/scenes/scenes.hpp"

namespace cullet {
namespace {

constexpr float kTableHeight = 0.75f, kTableDepth = 0.8f;
constexpr Vec3 kWood{0.28f, 0.17f, 0.09f};

Keys vase_keys() {
    Keys keys = common_keys("porcelain", 0.005, 0.0075);
    keys.number("scene.height_m", "m", 1.5, 0.01, 20, "of the fall onto the table")
        .number("scene.speed_mps", "m/s", 0, 0, 50, "downward at the start")
        .number("scene.size_m", "m", 0.3, 0.05, 3, "height of the vase");
    return keys;
}

/// The middle of the vase falls a little outside of the table's front edge, so that the belly meets the edge and what
/// is left goes on to the floor.
Result<ScenePlan> vase_plan(const SceneInput& input) {
    const Keys& keys = input.keys;
    ScenePlan plan = begin_plan(input);
    const auto size = static_cast<float>(keys["scene.size_m"]);
    const Mesh mesh = make_vase(size, static_cast<float>(keys["scene.edge_m"]), plan.seed);
    if (auto cooked = cook_into(plan, input, mesh); !cooked.ok()) return Error{cooked.error()};
    plan.props.push_back(floor_prop());
    Prop table;
    table.mesh = make_table(1.2f, kTableDepth, kTableHeight);
    table.colour = kWood;
    plan.props.push_back(table);

    Spawn vase;
    vase.settings.user_data = 1;
    vase.settings.strength_scale = static_cast<float>(keys["scene.strength_scale"]);
    vase.settings.pose.orientation =
        turn({static_cast<float>(seeded(keys, 1)), 0.2f, static_cast<float>(seeded(keys, 2))},
             0.35 + 0.35 * seeded(keys, 3));
    const Vec3 middle{static_cast<float>(0.2 * seeded(keys, 4)),
                      kTableHeight + 0.5f * size + static_cast<float>(keys["scene.height_m"]),
                      0.5f * kTableDepth + 0.05f * size * static_cast<float>(1 + seeded(keys, 5))};
    vase.settings.pose.position = middle - rotate(vase.settings.pose.orientation, {0, 0.5f * size, 0});
    vase.settings.motion.velocity = {0, -static_cast<float>(keys["scene.speed_mps"]), 0};
    plan.spawns.push_back(vase);
    plan.camera = {{0.75f, 1.15f, 2.0f}, {0, 0.5f, 0.45f}, 0.74f};
    return plan;
}

constexpr uint32_t kSheet[] = {26, 32, 38, 41, 44, 48, 54, 62, 72, 90, 150, 599};

}  // namespace

const Scene kVaseScene{"vase",    "a porcelain vase falls on the edge of a table and from there to the floor",
                       600,       kSheet,
                       vase_keys, vase_plan};

}  // namespace cullet
