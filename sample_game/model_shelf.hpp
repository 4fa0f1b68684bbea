// Models that were cooked before, so that a run that is played again does not cook again.
#pragma once
#include <map>
#include <string>

#include "cullet/model.hpp"
#include "engine/mesh.hpp"

namespace cullet {

class ModelShelf {
 public:
    /// The model of this mesh and these settings; cooked, slowly, if it is not there. One thread at a time.
    Result<Model> cook(const Mesh& mesh, const CookSettings& settings);

 private:
    std::map<std::string, Model> models_;  // by mesh and settings
};

}  // namespace cullet
