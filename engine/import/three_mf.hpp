// A strict reader of 3MF: a ZIP of XML. assimp 5.2 drops the unit and what stands in parts of their own, and crashes on
// thumbnails.
#pragma once
#include <string>

#include "cullet/result.hpp"
#include "engine/import/corners.hpp"

namespace cullet {

/// What the build names, with components in components and parts that others name, in metres. The axes stay: 3MF knows
/// the top of a printer, not that of the model. `file` is the model's real path, `path` what sentences call it.
Result<Corners> read_3mf(const std::string& file, const std::string& path);

}  // namespace cullet
