// The files of the data folder, and what its README says of them.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace cullet::test {

/// All that stands below the folder, sorted, without its README, licences and tools.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder);

/// What stands beside the meshes and is none: buffers that a glTF names, point sets, a rope's graph, tetrahedra.
bool is_companion(const std::filesystem::path& file);

/// The column "wanted" of the README's table of broken files, by the name of the file: L, D, R or E.
std::map<std::string, char> wanted_of_hostile(const std::filesystem::path& readme);

}  // namespace cullet::test
