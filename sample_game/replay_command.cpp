#include "sample_game/replay_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "cullet/recording.hpp"
#include "sample_game/progress.hpp"

namespace cullet {

int replay_command(const ReplayOptions& options) {
    ReplaySettings settings;
    if (!options.against.empty()) settings.threads = options.against;
    std::optional<Progress> progress(std::in_place, "replaying " + options.file);
    settings.progress = [](void* user, float share) { static_cast<Progress*>(user)->show(static_cast<double>(share)); };
    settings.progress_user = &*progress;
    const Result<ReplayReport> report = replay(options.file, settings);
    progress.reset();
    if (!report.ok()) {
        fmt::print(stderr, "{}\n", report.error());
        return 2;
    }
    fmt::print("{}: {} frames gave their recorded hashes on {} threads; recorded with {}\n", options.file,
               report->frames, fmt::join(settings.threads, ", "), report->recorded_with);
    if (!report->difference.empty()) fmt::print(stderr, "{}: {}\n", options.file, report->difference);
    if (!report->damage.empty()) fmt::print(stderr, "{}\n", report->damage);
    return report->difference.empty() && report->damage.empty() ? 0 : 1;
}

}  // namespace cullet
