#include "engine/import/gltf/notes.hpp"

#include <algorithm>

#include "engine/import/gltf/extensions.hpp"
#include "engine/import/words.hpp"

namespace cullet::gltf {
namespace {

/// Over all primitives that are shown.
struct Held {
    bool has_colours = false, has_tangents = false, has_moved_uvs = false, has_other_uvs = false;
    uint64_t further_uvs = 0, targets = 0;
};

Held held_by(const Meshes& meshes) {
    Held held;
    for (const auto& [number, mesh] : meshes.known())
        for (const Primitive& primitive : mesh.primitives) {
            held.has_colours = held.has_colours || primitive.has_colours;
            held.has_tangents = held.has_tangents || primitive.has_tangents;
            held.has_moved_uvs = held.has_moved_uvs || (primitive.uv != nullptr && !primitive.coordinates.is_plain());
            held.has_other_uvs = held.has_other_uvs || (primitive.uv != nullptr && primitive.coordinates.others_differ);
            held.further_uvs = std::max(held.further_uvs, primitive.further_uvs);
            held.targets = std::max<uint64_t>(held.targets, primitive.targets.size());
        }
    return held;
}

std::string not_kept(const Document& document, const Held& held) {
    std::string text;
    const auto say = [&text](bool is_there, const std::string& what) {
        if (is_there) text += (text.empty() ? "Not kept: " : ", ") + what;
    };
    const uint64_t animations = document.count("animations"), cameras = document.count("cameras");
    const auto lights = document.root().find({"extensions", "KHR_lights_punctual", "lights"});
    say(held.has_colours, "vertex colours");
    say(held.has_tangents, "tangents");
    say(held.further_uvs > 0, counted(held.further_uvs, "further set", "further sets") + " of texture coordinates");
    say(held.targets > 0, counted(held.targets, "morph target", "morph targets") + " (applied by default weight)");
    say(animations > 0, counted(animations, "animation", "animations"));
    say(cameras > 0, counted(cameras, "camera", "cameras"));
    say(lights && lights->size() > 0, counted(lights ? lights->size() : 0, "light", "lights"));
    return text.empty() ? text : text + ".";
}

}  // namespace

void append_notes(std::vector<std::string>& notes, const Document& document, const Meshes& meshes, const Shown& shown) {
    const Held held = held_by(meshes);
    const auto say = [&notes](uint64_t n, const std::string& sentence) {
        if (n > 0 && !sentence.empty()) notes.push_back(sentence);
    };
    const size_t scenes = document.count("scenes");
    say(scenes > 1, "Of " + std::to_string(scenes) + " scenes the default one was read.");
    say(scenes == 0, "There is no scene: all nodes were read.");
    say(shown.primitives_without_points, counted(shown.primitives_without_points, "primitive has", "primitives have") +
                                             " no positions and nothing to show.");
    say(shown.corners_left_over,
        counted(shown.corners_left_over, "corner", "corners") + " at the ends of lists made no triangle.");
    say(shown.points_without_joint,
        counted(shown.points_without_joint, "point of a skin hangs", "points of skins hang") +
            " on no joint: the first joint moved them.");
    say(shown.weights_without_target,
        counted(shown.weights_without_target, "weight has", "weights have") + " no morph target.");
    say(held.has_moved_uvs, "Texture coordinates are those that the base colour is looked up with.");
    say(held.has_other_uvs, "Other textures of a material take other coordinates, which were not kept.");
    const std::vector<std::string> on_extensions = notes_on_extensions(document);
    notes.insert(notes.end(), on_extensions.begin(), on_extensions.end());
    say(1, not_kept(document, held));
}

}  // namespace cullet::gltf
