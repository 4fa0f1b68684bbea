#include "systems/api/replay.hpp"

namespace cullet {

Result<ReplayReport> replay(const std::string& path, const ReplaySettings& settings, const Host& host) {
    return replay_with(&World::create, path, settings, host);
}

}  // namespace cullet
