// A strict reader of STL, text and binary. assimp 5.2 refuses sound files of other programs: words in capital letters,
// lines before the first solid, bytes behind the last facet, normals that are no numbers.
#pragma once
#include <string>

#include "cullet/result.hpp"
#include "engine/import/corners.hpp"

namespace cullet {

/// Binary is what has as many bytes as its count of facets says, whatever word it begins with. Text is what has the
/// words of STL. What is neither but has more bytes than its count says is binary with something behind. Facets keep
/// the order of their corners; their normals are used where they are numbers of some length.
Result<Corners> read_stl(std::string bytes, const std::string& path);

}  // namespace cullet
