// Any model file as a mesh, by way of the program cullet_import that stands beside this one.
#pragma once
#include <string>

#include "cullet/result.hpp"
#include "engine/mesh.hpp"

namespace cullet {

/// A path without a file that names a generated shape ("cow", make_mesh_named) is that shape.
/// What the file holds and the mesh does not is said on standard error.
/// Shows a progress line while it waits. Results are kept in cache_folder().
Result<Mesh> import_model(const std::string& path);

}  // namespace cullet
