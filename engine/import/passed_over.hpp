// What assimp passes over in FBX without a word, told from the bytes of the file.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace cullet {

/// Text or binary: a unit that is not named, and geometry of classes that are no meshes.
std::vector<std::string> notes_of_fbx(std::string_view bytes);

}  // namespace cullet
