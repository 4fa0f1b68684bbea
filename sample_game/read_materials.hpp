// Materials from a TOML file: rows that are added, and values of old rows that change.
#pragma once
#include <string>

#include "cullet/material.hpp"

namespace cullet {

/// A table of the file is a material by its name. A name that `table` has changes the values given. A new one starts as
/// the row that `like` names, or gives all values of its kind itself. Those across the grain, bending_stiffness,
/// branching and run_out may be missing, and are 0 then. So may heading_power, tip_factor and run_seconds, which are as
/// in MaterialSettings then. Keys: those of material_values() that decide something in its kind, kind, fracture, like.
/// A refusal names file, line, material, key, value and range, and leaves the table as it was.
Result<void> read_materials(const std::string& path, MaterialTable& table);

}  // namespace cullet
