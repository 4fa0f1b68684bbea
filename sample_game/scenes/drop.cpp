#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/math.hpp"
#include "sample_game/import_model.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/scenes/scenes.hpp"

namespace cullet {
namespace {

Keys drop_keys() {
    Keys keys = common_keys("porcelain", 0.006, 0);
    keys.number("scene.speed_mps", "m/s", 7, 0, 100, "toward the wall")
        .number("scene.height_m", "m", 0.7, 0.05, 20, "of its middle above the floor")
        .number("scene.size_m", "m", 0.4, 0.01, 10, "largest side of the mesh");
    return keys;
}

/// Scaled so that its largest side is `size`, with the middle of its box at the origin. False for a mesh of no extent.
bool fit(Mesh& mesh, float size) {
    Vec3 low = mesh.positions[0], high = low;
    for (const Vec3 p : mesh.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const float largest = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    if (!(largest > 0)) return false;
    const Vec3 middle = 0.5f * (low + high);
    for (Vec3& p : mesh.positions) p = (size / largest) * (p - middle);
    return true;
}

/// A blow that does not fit a hold ends late: raises the budget until the predicted one fits, and says so in place of
/// cooking's advice to do that.
void raise_budget(ScenePlan& plan) {
    const double frames =
        std::floor(static_cast<double>(plan.settings.hold_seconds / plan.settings.step_seconds) + 1e-3);
    const uint64_t hit = plan.models[0].report().units_of_a_hit;
    if (frames < 1) return;
    const auto wanted = static_cast<uint64_t>(1.1 * static_cast<double>(hit) / frames);
    if (wanted <= plan.settings.units_a_frame) return;
    std::erase(plan.notes, plan.models[0].report().advice);
    plan.notes.push_back(
        fmt::format("A hit on this mesh takes {:.0f} million units: units_a_frame was raised from {:.1f} to {:.1f} "
                    "million so that it fits a hold of {:.0f} frames.",
                    1e-6 * static_cast<double>(hit), 1e-6 * static_cast<double>(plan.settings.units_a_frame),
                    1e-6 * static_cast<double>(wanted), frames));
    plan.settings.units_a_frame = wanted;
}

/// Any mesh as hollow porcelain, thrown at a wall; what is left falls to the floor.
Result<ScenePlan> drop_plan(const SceneInput& input) {
    const Keys& keys = input.keys;
    ScenePlan plan = begin_plan(input);
    const double edge = keys["scene.edge_m"];
    Mesh mesh;
    if (input.mesh_path.empty()) {
        mesh = make_piggy_bank(0.40f, edge > 0 ? static_cast<float>(edge) : 0.0098f, plan.seed);
    } else {
        Result<Mesh> imported = import_model(input.mesh_path);
        if (!imported.ok()) return Error{imported.error()};
        mesh = std::move(imported).value();
    }
    const auto size = static_cast<float>(keys["scene.size_m"]);
    if (!fit(mesh, size))
        return Error{
            fmt::format("{}: all of its points lie on one spot; give a mesh with an extent.", input.mesh_path)};
    if (auto cooked = cook_into(plan, input, mesh); !cooked.ok()) return Error{cooked.error()};
    raise_budget(plan);
    plan.props.push_back(floor_prop());
    plan.props.push_back(box_prop({-1.6f, -0.3f, -0.3f}, {1.6f, 1.6f, 0}, {0.38f, 0.40f, 0.42f}));

    Spawn body;
    body.settings.user_data = 1;
    body.settings.strength_scale = static_cast<float>(keys["scene.strength_scale"]);
    body.settings.pose.orientation = turn({static_cast<float>(seeded(keys, 1)), 1, static_cast<float>(seeded(keys, 2))},
                                          3.14159265 * seeded(keys, 3));
    body.settings.pose.position = {0, static_cast<float>(keys["scene.height_m"]), 0.3f + 1.8f * size};
    const auto speed = static_cast<float>(keys["scene.speed_mps"]);
    body.settings.motion.velocity = {0, 0.1f * speed, -speed};
    plan.spawns.push_back(body);
    plan.camera = {{1.25f, 0.98f, 1.66f}, {0.06f, 0.36f, 0.33f}, 0.72f};
    return plan;
}

constexpr uint32_t kSheet[] = {0, 6, 10, 13, 16, 20, 25, 32, 42, 60, 120, 599};

}  // namespace

const Scene kDropScene{"drop",    "a mesh (--mesh FILE, or a piggy bank) is thrown at a wall as hollow porcelain",
                       600,       kSheet,
                       drop_keys, drop_plan};

}  // namespace cullet
