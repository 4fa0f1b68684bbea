// A folder of files that can be made again: imported meshes and cooked models, named after what they were made from.
#pragma once
#include <cstdint>
#include <string>

namespace cullet {

/// The first that can be written: mesh_cache beside the program, where it was built; cullet in $XDG_CACHE_HOME or
/// ~/.cache; a folder of this user's own among the system's temporary files. Empty when there is none: then nothing is
/// kept.
std::string cache_folder();

inline constexpr uint64_t kMostCacheBytes = 1ull << 30;

/// Marks an entry as used now.
void touch_entry(const std::string& path);
/// Removes entries (.cmesh, .cmodel), the longest unused first, until the rest fits, and what a run that was ended left
/// half written an hour ago or more. Files of other names stay. Any number of processes may do so at once.
void trim_cache(const std::string& folder, uint64_t most_bytes = kMostCacheBytes);

}  // namespace cullet
