// What a load parts a solid along: a plane, askew by a little. Its cells make the faces rough.
#pragma once
#include "components/body_rows.hpp"
#include "components/solid_rows.hpp"
#include "systems/bodies/cut_by_load.hpp"

namespace cullet {

/// Asks for a cut through the section, moved so that a tenth of the body is left on either side. False: no row of Blows
/// is free.
bool part_solid_by_load(Read<All<SolidRows, Bodies>> rows, Blows& blows, Row<Bodies> body,
                        const LoadedSection& section);

}  // namespace cullet
