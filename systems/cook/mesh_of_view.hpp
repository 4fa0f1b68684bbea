// The caller's arrays as a mesh of ours.
#pragma once
#include "cullet/model.hpp"
#include "engine/mesh.hpp"

namespace cullet {

/// A copy that fulfils validate_mesh, or a sentence.
Result<Mesh> mesh_of_view(const MeshView& view);

}  // namespace cullet
