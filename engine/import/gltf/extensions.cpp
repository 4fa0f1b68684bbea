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
/// Whole names: of an extension that only begins like one of these nobody knows what it does to a shape.
constexpr std::string_view kBesideTheMesh[] = {"KHR_materials_anisotropy",
                                               "KHR_materials_clearcoat",
                                               "KHR_materials_common",
                                               "KHR_materials_diffuse_transmission",
                                               "KHR_materials_dispersion",
                                               "KHR_materials_emissive_strength",
                                               "KHR_materials_ior",
                                               "KHR_materials_iridescence",
                                               "KHR_materials_pbrSpecularGlossiness",
                                               "KHR_materials_sheen",
                                               "KHR_materials_specular",
                                               "KHR_materials_subsurface",
                                               "KHR_materials_transmission",
                                               "KHR_materials_unlit",
                                               "KHR_materials_variants",
                                               "KHR_materials_volume",
                                               "KHR_materials_volume_scatter",
                                               "ADOBE_materials_clearcoat_specular",
                                               "ADOBE_materials_clearcoat_tint",
                                               "ADOBE_materials_thin_transparency",
                                               "MSFT_packing_normalRoughnessMetallic",
                                               "MSFT_packing_occlusionRoughnessMetallic",
                                               "KHR_texture_basisu",
                                               "EXT_texture_webp",
                                               "EXT_texture_avif",
                                               "MSFT_texture_dds",
                                               "KHR_lights_punctual",
                                               "EXT_lights_image_based",
                                               "EXT_lights_ies",
                                               "KHR_audio",
                                               "KHR_audio_emitter",
                                               "KHR_animation_pointer",
                                               "KHR_xmp",
                                               "KHR_xmp_json_ld",
                                               "EXT_mesh_features",
                                               "EXT_instance_features",
                                               "EXT_structural_metadata",
                                               "AGI_articulations",
                                               "AGI_stk_metadata",
                                               "VRM",
                                               "VRMC_vrm",
                                               "VRMC_vrm_animation",
                                               "VRMC_materials_mtoon",
                                               "VRMC_materials_hdr_emissiveMultiplier",
                                               "VRMC_springBone",
                                               "VRMC_springBone_extended_collider",
                                               "VRMC_node_constraint"};

/// Not required, they only repeat what stands in the file in plain form as well.
constexpr std::string_view kPacked[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

bool is_honoured(std::string_view name) {
    return std::find(std::begin(kHonoured), std::end(kHonoured), name) != std::end(kHonoured);
}

bool is_beside_the_mesh(std::string_view name) {
    return std::find(std::begin(kBesideTheMesh), std::end(kBesideTheMesh), name) != std::end(kBesideTheMesh);
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
