// A scene is a script: one of the program's own, or a file. A plan is all that it takes to play it again and again.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cullet/result.hpp"
#include "sample_game/keys.hpp"

namespace cullet {

class ModelShelf;

struct Scene {
    std::string name;  // "vase", or the path of a file
    std::string file;  // as errors name it: "vase.lua"
    std::string text;
};

/// The program's own (sample_game/scenes/*.lua).
std::span<const Scene> scenes();
const Scene* find_scene(const std::string& name);
/// One of the program's own by its name, or a file that ends in .lua.
Result<Scene> load_scene(const std::string& name);

/// What a script says of itself before it does anything.
struct Story {
    std::string shows;                   // a sentence: what is seen
    double seconds = 10;                 // a run's length
    bool has_length = false;             // the script gave one
    std::vector<uint32_t> sheet_frames;  // twelve, at 60 steps a second, that tell it
    Keys keys;                           // with --set and --threads applied
};

struct ScenePlan {
    Scene scene;
    std::vector<std::string> set;  // KEY=VALUE
    uint32_t threads = 0;          // 0: all that the machine has, or the key's
    double step_ms = 1000.0 / 60;
    std::string mesh_path, model;       // of --mesh and --model; empty: the script's own
    std::string materials_path;         // of --materials; empty: none
    std::string record;                 // a file; empty: nothing is written down
    bool is_silent = false;             // print() says nothing: the run before said it
    std::shared_ptr<ModelShelf> shelf;  // what its runs have cooked
};

/// Runs the script as far as its declarations go. Refuses a --set that names none of its keys.
Result<Story> read_story(const ScenePlan& plan);

}  // namespace cullet
