#include "systems/api/replay.hpp"
#include "systems/api/with_models.hpp"

namespace cullet {

Result<ReplayReport> replay(const std::string& path, const ReplaySettings& settings, const Host& host) {
    return replay_with(damage_models(), path, settings, host);
}

Result<ReplayReport> replay_with(const ModelList& models, const std::string& path, const ReplaySettings& settings,
                                 const Host& host) {
    return replay_all(models, &create_with, path, settings, host);
}

}  // namespace cullet
