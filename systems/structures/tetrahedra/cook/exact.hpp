// Which side of a plane: exact, because every point stands on an integer grid. All decisions of a cut are such signs,
// so they agree with each other, however thin a wall or a sliver is (solid cooking note, 4.1).
#pragma once
#include <cstdint>

namespace cullet {

/// Integers below 2^22 in size, held as double: their differences and 2 x 2 minors are exact.
struct GridPoint {
    double x = 0, y = 0, z = 0;
};
inline bool operator==(const GridPoint& a, const GridPoint& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// Three products of up to 2^68 are rounded and added: below it, the sign of their sum is not sure.
inline constexpr double kSureDeterminant = 4e5;

/// In 128-bit integers, rounded to double at the end.
double exact_determinant(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d);

/// Six times the volume of the tetrahedron a, b, c, d in grid units: positive when d lies on the side from which a, b,
/// c run counter-clockwise. Its sign is exact.
inline double determinant(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
    const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
    const double cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
    const double dx = d.x - a.x, dy = d.y - a.y, dz = d.z - a.z;
    const double value = dx * (by * cz - bz * cy) + dy * (bz * cx - bx * cz) + dz * (bx * cy - by * cx);
    if (value > kSureDeterminant || value < -kSureDeterminant) return value;
    return exact_determinant(a, b, c, d);
}
inline int sign_of(double value) {
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

}  // namespace cullet
