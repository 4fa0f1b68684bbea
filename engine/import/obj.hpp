// OBJ files, read here: assimp 5.2 drops lines with a blank in front, drops all texture coordinates for one wrong
// number, and reads "1,5" as 1.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "engine/import/corners.hpp"

namespace cullet {

/// The text of a file that the model names, by the name that stands there; nothing when it is not there.
using ReadBeside = std::function<std::optional<std::string>(const std::string& name)>;

/// Points, faces, normals, texture coordinates; a material is its place in the MTL files, or of its first use. Refuses
/// points that are not three finite numbers, and faces that name what is not there. The sentence names the
/// line, what stands in it and what should. What went unread is a note.
Result<Corners> read_obj(std::string bytes, const std::string& path, const ReadBeside& read_beside);

}  // namespace cullet
