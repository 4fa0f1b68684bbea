// The closed surface of a solid: of a whole one the mesh as it came, of a piece what is left of it and its crack faces.
#pragma once
#include <array>

#include "components/solid_rows.hpp"
#include "cullet/result.hpp"

namespace cullet {

struct SkinRange {
    Range points, triangles;  // SkinPoints, SkinTriangles
};
SkinRange skin_of(Read<SolidRows> rows, Row<Structures> structure);

/// Writes mass, centre, inertia and area of the structure and the volume of its solid.
void measure_solid(SolidRows rows, Row<Structures> structure);

/// No point of the skin is farther from the structure's centre, m.
float radius_of_solid(Read<SolidRows> rows, Row<Structures> structure);

/// What its birth costs is counted by them.
uint32_t points_at_birth(Read<SolidRows> rows, Row<Structures> structure);

/// Of a face inside the solid: metres along two directions in its plane, from 0 on, of a mesh in this box. Faces that
/// lie in one plane go on.
std::array<float, 2> inside_uv(Vec3d place, Vec3d normal, Vec3d low, Vec3d high);

/// That it closes: every edge of a triangle runs back as often. For tests and --validate; it allocates.
Result<void> check_skin(Read<SolidRows> rows, Row<Structures> structure);

}  // namespace cullet
