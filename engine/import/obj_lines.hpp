// Lines of an OBJ file that are not what they should be. Assimp names none of them, and reads "1,5" as 1.
#pragma once
#include <string>
#include <string_view>

#include "cullet/result.hpp"

namespace cullet {

/// Refuses points that are not three finite numbers, and faces that name points which are not there. The sentence names
/// the line, what stands in it and what should. Of other lines it says nothing.
Result<void> check_obj(std::string_view text, const std::string& path);

}  // namespace cullet
