// A scene: what is cooked, what stands where, what is thrown, and from where one looks. All of it plain data, so that
// one plan can be run again and again, on any number of threads, and be drawn.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cullet/world.hpp"
#include "engine/mesh.hpp"
#include "sample_game/keys.hpp"
#include "sample_game/picture.hpp"

namespace cullet {

/// How a kind of body looks. Bodies carry its place in ScenePlan::looks as their user data; fragments inherit it.
struct Look {
    float opacity = 1, gloss = 0.25f;
};

/// A body of a cooked model.
struct Spawn {
    uint32_t model = 0;  // in ScenePlan::models
    SpawnSettings settings;
    std::vector<Box> pins;
    uint64_t frame = 0;  // before this step
};

/// Something that never moves: met by all, drawn in one colour.
struct Prop {
    Mesh mesh;  // world coordinates
    ContactSettings contact;
    Vec3 colour{0.45f, 0.42f, 0.38f};
};

struct ScenePlan {
    Settings settings;
    uint64_t seed = 1;  // of places, turns, strengths and generated meshes
    Camera camera;
    Sun sun;
    float ground_height = 0;      // m, of the drawn ground
    std::vector<Look> looks{{}};  // 0: everything that no other was asked for
    std::vector<Model> models;
    std::vector<Prop> props;
    std::vector<Spawn> spawns;  // in order of frame
    std::vector<SphereSettings> balls;
    uint32_t fragments_wanted = 0;   // > 0: no more spawns once so many fragments live
    std::vector<std::string> notes;  // what a person should know, a sentence each
};

/// What the command line gives to a scene.
struct SceneInput {
    const Keys& keys;
    std::string mesh_path;  // empty: the scene's own
    float step_seconds = 1.0f / 60.0f;
    void (*progress)(void* user, float share) = nullptr;  // of cooking
    void* progress_user = nullptr;
};

struct Scene {
    const char* name;
    const char* shows;                       // a sentence: what is seen
    uint32_t frames;                         // a run's length at 60 steps a second
    std::span<const uint32_t> sheet_frames;  // twelve frames that tell the story
    Keys (*keys)();
    Result<ScenePlan> (*plan)(const SceneInput& input);
};

std::span<const Scene> scenes();
const Scene* find_scene(const std::string& name);

}  // namespace cullet
