#include <cmath>
#include <limits>

#include "engine/math.hpp"
#include "engine/random.hpp"
#include "sample_game/cache.hpp"
#include "sample_game/cook_cached.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/scenes/scenes.hpp"

namespace cullet {

Keys common_keys(const std::string& material, double thickness, double edge) {
    const Settings defaults;
    const double inf = std::numeric_limits<double>::infinity();
    Keys keys;
    keys.number("scene.seed", "1", 1, 0, 1e9, "seed of places, turns and strengths")
        .word("scene.material", material, "glass, porcelain, brick, concrete", "what breaks")
        .number("scene.thickness_m", "m", thickness, 1e-4, 1, "of the shell")
        .number("scene.edge_m", "m", edge, 0, 1, "edge length of the mesh; 0: what cooking chooses")
        .number("scene.strength_scale", "1", 1, 1e-3, inf, "on the material's strength; inf never cracks")
        .number("units_a_frame", "units", static_cast<double>(defaults.units_a_frame), 1e3, 1e15,
                "damage work a frame, 2 ns each")
        .number("hold_s", "s", static_cast<double>(defaults.hold_seconds), 0, 1,
                "longest hold of a blow that is being worked off")
        .number("generations", "1", defaults.generations, 0, 10, "fragments break again down to this one")
        .number("debris_share", "1", static_cast<double>(defaults.debris_share), 0, 0.5,
                "pieces lighter than this share of the whole are debris")
        .number("debris_elements", "1", defaults.debris_elements, 1, 1000, "pieces of fewer elements are debris")
        .number("gravity_mps2", "m/s2", 9.81, 0, 100, "downward")
        .number("threads", "1", 1, 1, 64, "threads that step the world; the same as --threads");
    return keys;
}

ScenePlan begin_plan(const SceneInput& input) {
    const Keys& keys = input.keys;
    ScenePlan plan;
    plan.settings.gravity = {0, -static_cast<float>(keys["gravity_mps2"]), 0};
    plan.settings.step_seconds = input.step_seconds;
    plan.seed = static_cast<uint64_t>(keys["scene.seed"]);
    plan.settings.threads = static_cast<uint32_t>(keys["threads"]);
    plan.settings.units_a_frame = static_cast<uint64_t>(keys["units_a_frame"]);
    plan.settings.hold_seconds = static_cast<float>(keys["hold_s"]);
    plan.settings.generations = static_cast<uint32_t>(keys["generations"]);
    plan.settings.debris_share = static_cast<float>(keys["debris_share"]);
    plan.settings.debris_elements = static_cast<uint32_t>(keys["debris_elements"]);
    const std::string& material = keys.word_of("scene.material");
    Look look;
    if (material == "glass") look = {0.4f, 1};
    if (material == "brick" || material == "concrete") look = {1, 0};
    plan.looks.push_back(look);  // 1: what breaks
    return plan;
}

Result<void> cook_into(ScenePlan& plan, const SceneInput& input, const Mesh& mesh) {
    CookSettings settings;
    settings.material = input.keys.word_of("scene.material");
    settings.thickness = static_cast<float>(input.keys["scene.thickness_m"]);
    settings.seed = static_cast<uint64_t>(input.keys["scene.seed"]);
    settings.progress = input.progress;
    settings.progress_user = input.progress_user;
    // The meshes that the project makes have the edge length asked for: leave them as they are. Strangers' meshes get
    // their longest edges split.
    settings.longest_edge = input.mesh_path.empty() ? 100.0f : static_cast<float>(input.keys["scene.edge_m"]);
    // What the project makes by itself is cooked anew each time: it changes with the project.
    Result<CachedModel> cooked = cook_cached(mesh, settings, input.mesh_path.empty() ? "" : cache_folder());
    if (!cooked.ok()) return Error{cooked.error()};
    if (cooked->is_from_cache) plan.notes.push_back("The cooked model was taken from the cache.");
    if (!cooked->trouble.empty()) plan.notes.push_back(cooked->trouble);
    const ModelReport& report = cooked->model.report();
    if (!report.repairs.empty()) plan.notes.push_back(report.repairs);
    if (!report.advice.empty()) plan.notes.push_back(report.advice);
    plan.models.push_back(std::move(cooked->model));
    return {};
}

MeshView view_of(const Mesh& mesh) {
    MeshView view;
    view.positions = mesh.positions.data();
    view.position_count = mesh.positions.size();
    view.indices = mesh.triangles.empty() ? nullptr : mesh.triangles[0].data();
    view.triangle_count = mesh.triangles.size();
    view.corner_normals = mesh.corner_normals.empty() ? nullptr : mesh.corner_normals.data();
    view.corner_uvs = mesh.corner_uvs.empty() ? nullptr : mesh.corner_uvs.data();
    view.materials = mesh.materials.empty() ? nullptr : mesh.materials.data();
    view.name = mesh.name.c_str();
    return view;
}

Mesh moved(Mesh mesh, Vec3 by) {
    for (Vec3& p : mesh.positions) p += by;
    return mesh;
}

Prop box_prop(Vec3 low, Vec3 high, Vec3 colour) {
    Prop prop;
    prop.mesh = moved(make_box(0.5f * (high - low)), 0.5f * (low + high));
    prop.colour = colour;
    return prop;
}

Prop floor_prop(float half_side, float height) {
    // Half a metre thick, so that nothing that the sweep leaves in it comes out below.
    return box_prop({-half_side, height - 0.5f, -half_side}, {half_side, height, half_side}, {0.30f, 0.29f, 0.27f});
}

double seeded(const Keys& keys, uint32_t number) {
    return 2 * Random{static_cast<uint64_t>(keys["scene.seed"])}.uniform(0x5ce9e, number) - 1;
}

Quat turn(Vec3 axis, double angle) {
    double sine = 0, cosine = 1;
    sine_cosine(0.5 * angle, sine, cosine);
    const Vec3 a = static_cast<float>(sine) * normalised(axis);
    return {a.x, a.y, a.z, static_cast<float>(cosine)};
}

Quat any_turn(const Keys& keys, uint32_t first_number) {
    // K. Shoemake, "Uniform random rotations", 1992.
    constexpr double kTurn = 6.283185307179586477;
    const double u = 0.5 * (seeded(keys, first_number) + 1);
    double s1 = 0, c1 = 0, s2 = 0, c2 = 0;
    sine_cosine(0.5 * kTurn * (seeded(keys, first_number + 1) + 1), s1, c1);
    sine_cosine(0.5 * kTurn * (seeded(keys, first_number + 2) + 1), s2, c2);
    const double a = std::sqrt(1 - u), b = std::sqrt(u);
    return normalised(Quat{static_cast<float>(a * s1), static_cast<float>(a * c1), static_cast<float>(b * s2),
                           static_cast<float>(b * c2)});
}

}  // namespace cullet
