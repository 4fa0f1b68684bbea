// Extensions of glTF: those that are honoured, those that nothing of a mesh file depends on, and all others.
#pragma once
#include <string>
#include <vector>

#include "engine/import/gltf/document.hpp"

namespace cullet::gltf {

/// Throws for a required extension that could change the triangles and is not read.
void check_required(const Document& document);

/// Sentences on extensions that are used, not required, and not read.
std::vector<std::string> notes_on_extensions(const Document& document);

}  // namespace cullet::gltf
