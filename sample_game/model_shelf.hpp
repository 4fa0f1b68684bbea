// Models that were cooked before, so that a run that is played again does not cook again.
#pragma once
#include <map>
#include <string>

#include "cullet/model.hpp"
#include "engine/mesh.hpp"
#include "sample_game/cook_cached.hpp"

namespace cullet {

class ModelShelf {
 public:
    /// The model of this mesh and these settings; cooked, slowly, if it is neither here nor in the folder (empty:
    /// none). One thread at a time.
    Result<CachedModel> cook(const Mesh& mesh, const CookSettings& settings, const std::string& folder);

 private:
    std::map<std::string, CachedModel> models_;  // by mesh and settings
};

}  // namespace cullet
