// Cooking, worlds and replays with a list of damage models that the caller gives. The public calls do the same with all
// that this version has (models/models.cpp); tests give lists of their own.
//
// A world keeps its list: a snapshot that it loads, and a recording that it makes, are of the same list.
#pragma once
#include "cullet/recording.hpp"
#include "cullet/world.hpp"
#include "systems/models.hpp"

namespace cullet {

/// model.hpp's cook and read_model.
Result<Model> cook_with(const ModelList& models, const MeshView& mesh, const CookSettings& settings);
Result<Model> read_model_with(const ModelList& models, const std::string& path, const Host* host = nullptr);
/// World::create. In cullet::cullet alone, as that is.
Result<World> create_with(const ModelList& models, const Settings& settings, const Host& host = {});
/// World::create_hosted.
Result<World> create_hosted_with(const ModelList& models, const Settings& settings, const Host& host = {});
/// recording.hpp's replay. In cullet::cullet alone.
Result<ReplayReport> replay_with(const ModelList& models, const std::string& path, const ReplaySettings& settings = {},
                                 const Host& host = {});

}  // namespace cullet
