#include "sample_game/scene.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "sample_game/embedded_scenes.hpp"
#include "sample_game/script/script.hpp"

namespace cullet {

std::span<const Scene> scenes() {
    static const std::vector<Scene> list = [] {
        std::vector<Scene> made;
        for (const EmbeddedScene& scene : embedded_scenes())
            made.push_back({scene.name, std::string(scene.name) + ".lua", scene.text});
        return made;
    }();
    return list;
}

const Scene* find_scene(const std::string& name) {
    for (const Scene& scene : scenes())
        if (name == scene.name) return &scene;
    return nullptr;
}

Result<Scene> load_scene(const std::string& name) {
    if (const Scene* own = find_scene(name)) return *own;
    if (!name.ends_with(".lua")) {
        std::string names;
        for (const Scene& scene : scenes()) names += (names.empty() ? "" : ", ") + scene.name;
        return Error{
            fmt::format("run {}: there is no such scene; give one of {}, or a file that ends in .lua.", name, names)};
    }
    std::ifstream file(name, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file && !file.eof())
        return Error{fmt::format("{}: cannot be read ({}); give the path of a script.", name, std::strerror(errno))};
    return Scene{name, name, std::move(text)};
}

Result<Story> read_story(const ScenePlan& plan) {
    Stage stage;
    stage.plan = plan;
    Script script(stage);
    if (auto done = script.declare(); !done.ok()) return Error{done.error()};
    return std::move(stage.story);
}

}  // namespace cullet
