// Primitives packed by KHR_draco_mesh_compression.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/import/gltf/accessors.hpp"

namespace cullet::gltf {

struct DracoMesh {
    std::map<std::string, Accessor> attributes;  // "POSITION", with the components that the primitive's accessor states
    std::vector<std::array<uint32_t, 3>> triangles;
};

/// `extension` stands at the primitive `primitive`.
DracoMesh decode_draco(const Document& document, Buffers& buffers, const Part& primitive, const Part& extension);

}  // namespace cullet::gltf
