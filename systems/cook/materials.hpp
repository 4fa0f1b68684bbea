// The compiled-in table of materials (thick shell note, section 8).
#pragma once
#include <string>

#include "components/materials.hpp"
#include "cullet/result.hpp"

namespace cullet {

/// Appends glass, porcelain, brick, concrete: the same rows in every world and model.
void fill_materials(Materials& materials);
/// Row of a material by name; an error names those there are.
Result<Row<Materials>> find_material(const std::string& name);

}  // namespace cullet
