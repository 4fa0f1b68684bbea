// The sentences on what a glTF holds and a mesh file does not.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/import/gltf/document.hpp"
#include "engine/import/gltf/primitives.hpp"

namespace cullet::gltf {

/// Counted while the scene is shown.
struct Shown {
    uint64_t primitives_without_points = 0;
    uint64_t corners_left_over = 0;
    uint64_t points_without_joint = 0;
    uint64_t weights_without_target = 0;
};

void append_notes(std::vector<std::string>& notes, const Document& document, const Meshes& meshes, const Shown& shown);

}  // namespace cullet::gltf
