// What a load parts a shell along: one jagged surface.
#pragma once
#include "components/body_rows.hpp"
#include "systems/bodies/cut_by_load.hpp"

namespace cullet {

/// Asks for a cut through the section, a little jagged. It is moved so that a tenth of the body is left on either side.
/// False: no row of Blows is free.
bool part_shell_by_load(const BodyRows& rows, Blows& blows, Row<Bodies> body, const LoadedSection& section);

}  // namespace cullet
