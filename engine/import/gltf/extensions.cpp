#include "engine/import/gltf/extensions.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "engine/mesh_file.hpp"

namespace cullet::gltf {
namespace {

constexpr size_t kMostNamed = 8;  // extensions in a sentence

constexpr std::string_view kHonoured[] = {"EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression",
                                          "KHR_mesh_quantization", "KHR_texture_transform"};

/// They tell of looks, light, sound, words and moves. A mesh file holds none of these, whether they are read or not.
constexpr std::string_view kBesideTheMesh[] = {"KHR_materials_",
                                               "ADOBE_materials_",
                                               "MSFT_packing_",
                                               "KHR_texture_basisu",
                                               "EXT_texture_webp",
                                               "EXT_texture_avif",
                                               "MSFT_texture_dds",
                                               "KHR_lights_punctual",
                                               "EXT_lights_image_based",
                                               "EXT_lights_ies",
                                               "KHR_audio",
                                               "KHR_animation_pointer",
                                               "KHR_xmp",
                                               "EXT_mesh_features",
                                               "EXT_instance_features",
                                               "EXT_structural_metadata",
                                               "AGI_",
                                               "VRM"};

/// Not required, they only repeat what stands in the file in plain form as well.
constexpr std::string_view kPacked[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

bool is_honoured(std::string_view name) {
    return std::find(std::begin(kHonoured), std::end(kHonoured), name) != std::end(kHonoured);
}

/// Names that end in "_" above, and families, stand for all that begin so.
bool is_beside_the_mesh(std::string_view name) {
    return std::any_of(std::begin(kBesideTheMesh), std::end(kBesideTheMesh),
                       [name](std::string_view known) { return name.substr(0, known.size()) == known; });
}

bool is_packed(std::string_view name) {
    return std::find(std::begin(kPacked), std::end(kPacked), name) != std::end(kPacked);
}

std::vector<std::string> names_in(const Document& document, const char* list) {
    std::vector<std::string> names;
    const auto part = document.root().find(list);
    for (size_t i = 0; part && i < part->size(); ++i) {
        const std::string& name = part->item(i).text();
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

/// "A" or "A", "B" and 3 more.
std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
        text += (i == 0 ? "\"" : ", \"") + one_line(names[i], 80) + "\"";
    if (names.size() > kMostNamed) text += " and " + std::to_string(names.size() - kMostNamed) + " more";
    return text;
}

std::string noun(size_t count) {
    return count == 1 ? "the extension " : "the extensions ";
}

}  // namespace

void check_required(const Document& document) {
    std::vector<std::string> unread = names_in(document, "extensionsRequired");
    std::erase_if(unread, [](const std::string& name) { return is_honoured(name) || is_beside_the_mesh(name); });
    if (!unread.empty())
        throw Refusal("requires " + noun(unread.size()) + listed(unread) + ", which cullet does not read",
                      "Export the model without " + std::string(unread.size() == 1 ? "it." : "them."));
}

std::vector<std::string> notes_on_extensions(const Document& document) {
    std::vector<std::string> notes, unread;
    for (const std::string& name : names_in(document, "extensionsUsed")) {
        if (name == "KHR_materials_variants") notes.push_back("Of the variants of materials the default was taken.");
        if (!is_honoured(name) && !is_beside_the_mesh(name) && !is_packed(name)) unread.push_back(name);
    }
    if (!unread.empty()) notes.push_back("Read without " + noun(unread.size()) + listed(unread) + ".");
    return notes;
}

}  // namespace cullet::gltf
