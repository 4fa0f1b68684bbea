// Which texture coordinates a material asks for. A mesh file keeps one pair a corner and no pictures, so it keeps what
// the base colour is looked up with: its set, moved as KHR_texture_transform says.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "engine/import/gltf/document.hpp"

namespace cullet::gltf {

struct TextureCoordinates {
    uint64_t set = 0;
    double linear[4] = {1, 0, 0, 1};  // u' = linear[0] u + linear[1] v + move[0], v' alike
    double move[2] = {0, 0};
    bool others_differ = false;  // another texture of the material takes another set, or moves it otherwise

    bool is_plain() const;
    bool operator==(const TextureCoordinates& other) const;
};

/// `material` as the primitive names it; without one, or without a texture, set 0 as it is.
TextureCoordinates coordinates_of(const Document& document, const std::optional<Part>& material);

}  // namespace cullet::gltf
