// The tables of a solid in a model file.
#pragma once
#include "engine/table_bytes.hpp"
#include "systems/cook/model_contents.hpp"

namespace cullet {

/// What stands behind the row of structures: a row of solids, one of cooked solids, and the tables of both.
struct FoundSolid {
    FoundTable solid, cooked;
    std::vector<FoundTable> cooked_parts, parts;  // in the order of for_each_cooked_range and for_each_solid_range
};
void put_solid(ByteWriter& writer, Workbench& state, Row<Structures> structure);
FoundSolid find_solid(ByteReader& reader);
/// Room for the solid alone.
Limits limits_for(const FoundSolid& found);
/// Into a state that has room; what is wrong is told without the file's name.
Result<Row<Structures>> copy_solid(Workbench& state, const FoundTable& structure, const FoundSolid& found);

}  // namespace cullet
