#include "systems/api/host_log.hpp"

#include <cstdio>
#include <cstring>

#include "components/body_id.hpp"

namespace cullet {

bool HostLog::is_new(const char* setting, const Step& step) {
    const auto quiet = static_cast<uint64_t>(kQuietSeconds / step.dt);
    for (Told& told : told_) {
        if (!told.setting) {
            told = {setting, step.frame};
            return true;
        }
        if (std::strcmp(told.setting, setting) != 0) continue;
        if (step.frame < told.frame + quiet) return false;
        told.frame = step.frame;
        return true;
    }
    return false;
}

void HostLog::tell(const Host& host, const WorldData& data) {
    if (!host.log) return;
    char sentence[256];
    for (const RefusedEvent& e : data.told.of<RefusedEvent>()) {
        if (!is_new(e.setting, data.step_info)) continue;
        const char* format =
            std::strcmp(e.setting, kCrackRoom) == 0
                ? "%s: cracks of body %u (user data %llu) filled their room; cook it with a shorter longest_edge."
                : "Settings::%s is reached, asked for by body %u (user data %llu); raise it, or have less at once.";
        std::snprintf(sentence, sizeof sentence, format, e.setting, e.body.index,
                      static_cast<unsigned long long>(e.body_user_data));
        host.log(host.user, LogLevel::Warning, sentence);
    }
    for (const SqueezedEvent& e : data.told.of<SqueezedEvent>()) {
        std::snprintf(sentence, sizeof sentence,
                      "Body %u (user data %llu) is squeezed by body %u (user data %llu) and cannot give way.",
                      e.body.index, static_cast<unsigned long long>(e.body_user_data), e.by.index,
                      static_cast<unsigned long long>(e.by_user_data));
        host.log(host.user, LogLevel::Warning, sentence);
    }
    for (const FaultEvent& e : data.told.of<FaultEvent>()) {
        std::snprintf(sentence, sizeof sentence, "Body %u (user data %llu): %s", e.body.index,
                      static_cast<unsigned long long>(e.body_user_data), e.reason);
        host.log(host.user, LogLevel::Error, sentence);
    }
}

void HostLog::advise(const Host& host, const Model::Contents& model, uint64_t hold_units) const {
    if (!host.log || model.report.advice.empty() || model.report.units_of_a_hit <= hold_units) return;
    host.log(host.user, LogLevel::Warning, (model.name + ": " + model.report.advice).c_str());
}

}  // namespace cullet
