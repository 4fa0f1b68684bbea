// The game's side of importing: strangers' files go through the program cullet_import, once for each content.
#pragma once
#include <functional>
#include <string>

#include "cullet/result.hpp"
#include "engine/mesh.hpp"

namespace cullet {

/// Called ten times a second while the program reads, with the seconds gone and the seconds that it has at most.
using ImportWaiting = std::function<void(double seconds, double most)>;

/// A mesh file is read as it is. Any other model is given to the program, and the result is kept in cache_folder, which
/// is made if missing. Its name is the XXH3-128 of the file's bytes, its extension (which chooses the reader), and the
/// versions of the program and of assimp. For glTF the files that it names and may open count as well. A cached file
/// that no longer reads is made anew. A glTF that names too many files, or too large ones, is imported each time. The
/// mesh is named after the file. `notes`, if asked for, gets the sentences on what the model holds and the mesh does
/// not, as they were when it was imported, or nothing. Blocks for up to 14 s, and 20 should the program itself hang;
/// safe on any thread, and in several processes that share a folder.
Result<Mesh> import_mesh(const std::string& path, const std::string& program_path, const std::string& cache_folder,
                         const ImportWaiting& waiting = {}, std::string* notes = nullptr);

}  // namespace cullet
