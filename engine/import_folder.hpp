// Which files a model may open: itself, and ordinary files in its own folder and below. A model that names
// "../../secret" gets nothing. The importer asks it for what assimp opens, the game for what a cache entry depends on.
#pragma once
#include <filesystem>
#include <string>

namespace cullet {

class ModelFolder {
 public:
    explicit ModelFolder(const std::string& model);

    /// The real path of an allowed file that is there, or "". `file` is a path as a reader forms it: the model's own,
    /// or what stands before its last slash and a name from the model.
    std::string find(const std::string& file) const;
    /// The same for a name alone.
    std::string find_beside(const std::string& name) const { return find(given_ + name); }

 private:
    std::string given_;                   // the model's path as given, to its last slash
    std::filesystem::path model_, home_;  // the real ones
};

}  // namespace cullet
