// The published springs: every edge pulls its ends towards the length that it had before the impact, and one that is
// far too long is cut short (metal shell note, section 7).
#pragma once
#include "systems/models/metal_shell/shared/metal_view.hpp"

namespace cullet {

/// Fills MetalVertices.area, which masses go by: before rounds of pulling.
void sum_areas(const MetalView& metal);
/// One round over all edges. Vertices that the impact moved yield by `moved_share` of what the others do: a tenth as
/// published; at 1 the sum of mass times way is zero.
void pull_edges(const MetalView& metal, double moved_share);

/// Edges longer than 1 + `most_stretch` of what they were before the impact are cut short along the way that they had
/// then, at the end that went farther.
void cut_long_edges(const MetalView& metal, double most_stretch);

/// Where that puts the end at `moved`, which was at `moved_before`.
Vec3d cut_short(Vec3d fixed, Vec3d fixed_before, Vec3d moved, Vec3d moved_before, double most_stretch);

}  // namespace cullet
