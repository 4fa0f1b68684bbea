#include "sample_game/scene.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "sample_game/embedded_scenes.hpp"
#include "sample_game/script/script.hpp"

namespace cullet {

namespace {

constexpr size_t kMostBytes = size_t{1} << 20;  // of a script; the largest of ours has 4 KiB

Result<Scene> read_script(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string text(kMostBytes + 1, '\0');
    if (file) file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (!file.eof() && !file.good())  // a folder opens, and is refused when it is read
        return Error{fmt::format("{}: cannot be read ({}); give the path of a script.", path, std::strerror(errno))};
    text.resize(static_cast<size_t>(file.gcount()));
    if (text.size() > kMostBytes)
        return Error{fmt::format("{}: has more than {} KiB; give a shorter script.", path, kMostBytes >> 10)};
    return Scene{path, path, std::move(text)};
}

}  // namespace

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
    return read_script(name);
}

Result<Story> read_story(const ScenePlan& plan) {
    Stage stage;
    stage.plan = plan;
    if (!plan.materials_path.empty())
        if (const Result<void> read = stage.read_materials(plan.materials_path); !read.ok()) return Error{read.error()};
    Script script(stage);
    if (auto done = script.declare(); !done.ok()) return Error{done.error()};
    return std::move(stage.story);
}

}  // namespace cullet
