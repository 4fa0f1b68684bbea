// What assimp reads, as triangles: its scene's meshes at their places.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/import/corners.hpp"
#include "engine/import/folder_files.hpp"

struct aiScene;

namespace cullet {

/// The file's coordinates in ours, and sentences on them.
using Place = std::function<Affine(const aiScene&, std::vector<std::string>& notes)>;

/// As the GlobalSettings of an FBX say.
Affine place_of_fbx(const aiScene& scene, std::vector<std::string>& notes);

/// The importer is never torn down: assimp 5.2 frees some of what it has read twice, and the process that reads ends
/// when it has handed over the result. `files` goes to the importer, which asks it for `name` where the model has
/// another. Meshes with bones stand as these rest.
Result<Corners> read_by_assimp(std::unique_ptr<FolderFiles> files, const std::string& path, const Place& place,
                               const std::string& name = "");

/// Before anything is read: from then on unreadable() knows when memory was what was lacking.
void watch_memory();
/// Throws std::bad_alloc when memory was lacking.
Error unreadable(const std::string& path, const std::string& reason);

}  // namespace cullet
