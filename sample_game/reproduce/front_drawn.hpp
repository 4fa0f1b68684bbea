// The published front propagation (section 3.2.3) on a small sheet, slow and plain, so that its states can be drawn.
// It is no part of generation.
#pragma once
#include <vector>

#include "systems/cook/surface.hpp"

namespace cullet::reproduce {

/// The inner surface at three moments, and which triangles had met.
struct FrontStates {
    std::vector<Vec3d> collided, set_back, done;
    std::vector<uint8_t> has_met;  // of each triangle, in the first collision
    size_t met = 0, left = 0;      // triangles of the first collision; pairs that meet in the end
    uint32_t rounds = 0, collisions = 0;
};

/// All vertices move by `thickness` / `rounds` against their normals; where two elements meet their inner vertices go
/// back and take half the step from then on. Ends when no step is above a hundredth of the thickness or all is deep.
FrontStates propagate_front(const Surface& surface, double thickness, uint32_t rounds);

/// A ridge like an upturned U, open below: x is across, z along. Half way up its sides it is narrower by twice `pinch`.
Mesh make_ridge(double width, double height, double length, double edge, double pinch = 0);

}  // namespace cullet::reproduce
