// Whether the rows of a solid that came from a file may be followed.
#pragma once
#include <string>

#include "components/solid_rows.hpp"

namespace cullet {

/// Of ranges that have been looked at: what is wrong, or nothing. Every number that names a row is looked at, and sums
/// that must fit each other; that a lattice covers its mesh is not.
std::string trouble_of_solid(Read<SolidRows> rows, Row<Structures> structure);

}  // namespace cullet
