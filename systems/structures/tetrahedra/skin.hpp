// The closed surface of a solid: of a whole one the mesh as it came, of a piece what is left of it and its crack faces.
#pragma once
#include "components/shell_rows.hpp"

namespace cullet {

struct SkinRange {
    Range points, triangles;  // SkinPoints, SkinTriangles
};
SkinRange skin_of(const SolidRows& rows, Row<Structures> structure);

/// Writes mass, centre, inertia and area of the structure and the volume of its solid.
void measure_solid(SolidRows& rows, Row<Structures> structure);

/// No point of the skin is farther from the structure's centre, m.
float radius_of_solid(const SolidRows& rows, Row<Structures> structure);

}  // namespace cullet
