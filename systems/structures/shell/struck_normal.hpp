// The way a ball's blow goes.
#pragma once
#include "components/shell_rows.hpp"

namespace cullet {

/// Of the shell's live vertices the nearest to a place (body frame, m), ties to the lower one; kNone if there is none.
uint32_t nearest_vertex(ShellView shell, Vec3 place);

/// A hull's corner or edge says little about the surface. So a ball's blow goes along the normal of the surface that it
/// strikes. That is the inward normals within `radius` (m) of the vertex nearest to `place`, averaged by mass, on the
/// side of the contact's own `normal` (unit, body axes). Where the two are more than 45 degrees apart, `normal` stays.
/// What follows from the normal (the speed along it, the mass that the striker sets against it) must be taken after
/// this. Taken before, a blow on an edge gave a ball 941 rad/s and two thirds more energy than there was.
Vec3 struck_normal(ShellView shell, Vec3 place, Vec3 normal, float radius);

}  // namespace cullet
