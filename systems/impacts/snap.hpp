// What is loaded beyond its strength, and no blow would break as a load does, comes apart along one jagged surface.
#pragma once
#include "components/blows.hpp"
#include "components/body_rows.hpp"
#include "components/solid_rows.hpp"

namespace cullet {

/// Asks for a cut through the place (body frame), across `normal`: a little jagged, the same for the same seed. The
/// section is moved so that a tenth of the body is left on either side. False: no row of Blows is free.
bool snap(Blows& blows, const ShellRows& rows, const Bodies& bodies, Row<Bodies> body, Vec3 place, Vec3 normal,
          uint64_t seed);

/// The same of a solid: a plane, askew by a little. Its cells make the faces rough.
bool snap_solid(Blows& blows, Read<SolidRows> rows, const Bodies& bodies, Row<Bodies> body, Vec3 place, Vec3 normal,
                uint64_t seed);

}  // namespace cullet
