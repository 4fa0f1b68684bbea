// The scenes, one a file, and what they share.
#pragma once
#include "sample_game/scene.hpp"

namespace cullet {

extern const Scene kWallScene, kVaseScene, kPaneScene, kPileScene, kDropScene;

/// Keys that every scene has, filled with the library's defaults and these.
Keys common_keys(const std::string& material, double thickness, double edge);
/// The world's settings, with gravity, step and the common keys.
ScenePlan begin_plan(const SceneInput& input);
/// Cooks with the scene's material, thickness and seed and adds the model to the plan.
Result<void> cook_into(ScenePlan& plan, const SceneInput& input, const Mesh& mesh);

MeshView view_of(const Mesh& mesh);
/// A box between two corners, as a prop.
Prop box_prop(Vec3 low, Vec3 high, Vec3 colour);
/// A floor around the origin with its upper side at y = height; the drawn ground lies on it.
Prop floor_prop(float half_side = 30, float height = 0);
Mesh moved(Mesh mesh, Vec3 by);

/// In [-1, 1), by the scene's seed and a number of the place where it is used.
double seeded(const Keys& keys, uint32_t number);
/// A turn by `angle` rad about `axis`.
Quat turn(Vec3 axis, double angle);
/// Any turn, all alike, from three numbers of seeded().
Quat any_turn(const Keys& keys, uint32_t first_number);

}  // namespace cullet
