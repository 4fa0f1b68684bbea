#include "sample_game/cache.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <vector>

namespace cullet {
namespace {

namespace fs = std::filesystem;

constexpr auto kOldestPart = std::chrono::hours(1);

struct Entry {
    fs::file_time_type used;
    uint64_t bytes;
    fs::path path;
};

/// A folder that somebody else may write to could be given meshes that are none of ours.
bool is_own_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    struct stat status {};
    return ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && ::access(folder.c_str(), W_OK) == 0 &&
           (status.st_uid == ::geteuid() || ::geteuid() == 0) && (status.st_mode & S_IWOTH) == 0;
}

std::vector<Entry> entries_of(const std::string& folder) {
    std::vector<Entry> entries;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        std::error_code gone;  // by another process
        const fs::path path = at->path();
        const auto used = fs::last_write_time(path, gone);
        const uint64_t bytes = gone ? 0 : fs::file_size(path, gone);
        if (gone) continue;
        if (path.extension() == ".part") {
            if (fs::file_time_type::clock::now() - used > kOldestPart) fs::remove(path, gone);
        } else if (path.extension() == ".cmesh" || path.extension() == ".cmodel" || path.extension() == ".notes") {
            entries.push_back({used, bytes, path});
        }
    }
    return entries;
}

}  // namespace

std::string cache_folder() {
    std::error_code error;
    const fs::path build = fs::read_symlink("/proc/self/exe", error).parent_path();
    std::vector<fs::path> candidates;
    if (!error && fs::exists(build / "CMakeCache.txt", error)) candidates.push_back(build / "mesh_cache");
    const char *cache = std::getenv("XDG_CACHE_HOME"), *home = std::getenv("HOME");
    if (cache != nullptr && cache[0] == '/')
        candidates.push_back(fs::path(cache) / "cullet");
    else if (home != nullptr && home[0] == '/')
        candidates.push_back(fs::path(home) / ".cache" / "cullet");
    const fs::path temporary = fs::temp_directory_path(error);
    if (!error) candidates.push_back(temporary / ("cullet_mesh_cache." + std::to_string(::geteuid())));
    for (const fs::path& candidate : candidates)
        if (is_own_folder(candidate)) return candidate;
    return {};
}

void touch_entry(const std::string& path) {
    ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);
}

void trim_cache(const std::string& folder, uint64_t most_bytes) {
    std::vector<Entry> entries = entries_of(folder);
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.used != b.used ? a.used < b.used : a.path < b.path; });
    uint64_t bytes = 0;
    for (const Entry& entry : entries) bytes += entry.bytes;
    for (const Entry& entry : entries) {
        if (bytes <= most_bytes) return;
        std::error_code gone;
        fs::remove(entry.path, gone);
        bytes -= entry.bytes;
    }
}

}  // namespace cullet
