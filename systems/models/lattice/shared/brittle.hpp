// A material's row as the break of a solid takes it.
#pragma once
#include "components/shell_rows.hpp"
#include "systems/models/lattice/crack/blow.hpp"

namespace cullet {

BrittleSolid brittle_of(const Materials& m, Row<Materials> material);

}  // namespace cullet
