// Any model file as a mesh, by way of the program cullet_import that stands beside this one.
#pragma once
#include <string>

#include "cullet/result.hpp"
#include "engine/mesh.hpp"

namespace cullet {

/// Results are kept in the folder mesh_cache beside the program, or in the system's folder for temporary files when
/// that one cannot be written.
Result<Mesh> import_model(const std::string& path);

}  // namespace cullet
