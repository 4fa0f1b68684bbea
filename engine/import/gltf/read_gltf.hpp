// glTF 2.0 and GLB, read as the format says: assimp 5.2 copies integers as if they were floats, and knows no skins at
// rest, no default weights of morph targets, no instances and no required extensions.
#pragma once
#include "cullet/result.hpp"
#include "engine/import/corners.hpp"
#include "engine/import/gltf/document.hpp"

namespace cullet::gltf {

/// A document of version 2. Throws a Refusal, as the document's constructor does.
Corners read_document(const Document& document);

/// A Refusal as the sentence that a person gets.
Error error_of(const Refusal& refusal, const std::string& path);

}  // namespace cullet::gltf
