// Do two triangles touch? Separating axes in double precision; what cannot be shown apart counts as touching. Corners
// that are the same point by construction are compared by id, not by position, so that neighbours are not in each
// other's way.
#pragma once
#include <array>
#include <cstdint>

#include "engine/math.hpp"

namespace cullet {

/// In local coordinates (diagonal 0.5 to 1): a gap below this is rounding, not space.
inline constexpr double kLeastGap = 1e-11;

struct Corner3 {
    std::array<Vec3d, 3> point;
    std::array<uint32_t, 3> id;  // equal ids: the same point
};

/// The axes that separated a pair last time, tried first.
struct AxisHint {
    uint8_t first = 0, second = 0;
};

/// No shared corner: an axis separates them. One: the edge opposite to it of each is apart from the other triangle (two
/// triangles through one point that meet elsewhere meet on such an edge). Two: they are not folded onto each other by
/// less than 1.8 degrees. Three, or a triangle without three corners: never touching.
bool are_touching(const Corner3& a, const Corner3& b, AxisHint& hint);

/// The axis that separated two triangles without a shared corner, once are_touching said no; unit. 0: they share one.
Vec3d separating_axis(const Corner3& a, const Corner3& b, const AxisHint& hint);

}  // namespace cullet
