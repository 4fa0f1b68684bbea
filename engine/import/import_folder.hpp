// Which files a model may open: itself, and ordinary files in its own folder and below. A model that names
// "../../secret" gets nothing.
//
// A model that is a link has two folders, the link's and the one where it leads. In stores of content (and in folders
// made of links to one) every file leads into a folder of its own; so beside a model that is a link, names may be links
// that lead anywhere. Whoever put the links there chose the files; a model cannot. Beside an ordinary model a link is
// followed inside the folder only.
//
// glTF names are percent-encoded, but not by all programs: a name that is not there as it stands is decoded.
//
// The importer asks it for what assimp opens, the game for what a cache entry depends on.
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
    std::string allowed(const std::string& file) const;

    std::string given_;                               // the model's path as given, to its last slash
    bool is_link_;                                    // the model's name, not one of its folders
    std::filesystem::path model_, home_, link_home_;  // real paths: the file, its folder, the folder of the name given
};

}  // namespace cullet
