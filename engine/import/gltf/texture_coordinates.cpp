#include "engine/import/gltf/texture_coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace cullet::gltf {
namespace {

/// Scaled, turned, moved. The text's own example, a quarter turn by +pi/2 and an offset of (0, 1), shows the lower left
/// quarter of a picture only when it turns this way, v counted from the top. Its lines of GLSL turn the other way; no
/// renderer follows them, nor does Khronos' test model (issue 1563 of KhronosGroup/glTF).
TextureCoordinates coordinates_of_texture(const Part& texture) {
    TextureCoordinates coordinates;
    coordinates.set = texture.whole("texCoord", 0, 255);
    const auto transform = texture.find({"extensions", "KHR_texture_transform"});
    if (!transform) return coordinates;
    coordinates.set = transform->whole("texCoord", coordinates.set, 255);
    const auto offset = transform->find("offset"), rotation = transform->find("rotation"),
               scale = transform->find("scale");
    const double angle = rotation ? rotation->number() : 0;
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const auto scales = scale ? scale->numbers(2) : std::vector<double>{1, 1};
    const auto moves = offset ? offset->numbers(2) : std::vector<double>{0, 0};
    coordinates.linear[0] = cosine * scales[0];
    coordinates.linear[1] = sine * scales[1];
    coordinates.linear[2] = -sine * scales[0];
    coordinates.linear[3] = cosine * scales[1];
    std::copy(moves.begin(), moves.end(), coordinates.move);
    return coordinates;
}

/// The base colour first, then those that most often share its coordinates.
const std::initializer_list<const char*> kTextures[] = {
    {"pbrMetallicRoughness", "baseColorTexture"},
    {"extensions", "KHR_materials_pbrSpecularGlossiness", "diffuseTexture"},
    {"emissiveTexture"},
    {"normalTexture"},
    {"pbrMetallicRoughness", "metallicRoughnessTexture"},
    {"occlusionTexture"}};

}  // namespace

bool TextureCoordinates::operator==(const TextureCoordinates& other) const {
    return set == other.set && std::equal(linear, linear + 4, other.linear) && std::equal(move, move + 2, other.move);
}

bool TextureCoordinates::is_plain() const {
    return *this == TextureCoordinates{};
}

TextureCoordinates coordinates_of(const Document& document, const std::optional<Part>& material) {
    if (!material) return {};
    const Part part = document.named("materials", *material);
    std::optional<TextureCoordinates> chosen;
    for (const auto& names : kTextures) {
        const auto texture = part.find(names);
        if (!texture) continue;
        const TextureCoordinates found = coordinates_of_texture(*texture);
        if (!chosen)
            chosen = found;
        else if (!(found == *chosen))
            chosen->others_differ = true;
    }
    return chosen.value_or(TextureCoordinates{});
}

}  // namespace cullet::gltf
