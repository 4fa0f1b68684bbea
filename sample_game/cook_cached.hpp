// Cooking once for each content: the model file is kept.
#pragma once
#include <string>

#include "cullet/model.hpp"
#include "engine/mesh.hpp"

namespace cullet {

struct CachedModel {
    Model model;
    bool is_from_cache = false;
    std::string trouble;  // a sentence when the model was cooked and could not be kept
};

/// The damage model that the settings name, or the first.
std::string model_label(const CookSettings& settings);
/// Everything of the settings' material that decides how a model comes out, as text.
std::string material_label(const CookSettings& settings);

/// cook(), or the model file that an earlier call left in the folder (empty: nothing is kept). The entry's name is a
/// hash of the mesh, the settings, the library's version and the bytes of this program, so that a build that cooks
/// otherwise never meets an older one's model. An entry that does not read is cooked anew.
Result<CachedModel> cook_cached(const Mesh& mesh, const CookSettings& settings, const std::string& folder);

}  // namespace cullet
