// The field of a crush: a closed shell that gives way over a wide contact (metal shell note D2).
#pragma once
#include "systems/models/metal_shell/shared/metal_view.hpp"
#include "systems/models/metal_shell/shared/striker.hpp"

namespace cullet {

struct CrushPlan {
    double depth = 0;  // d, m
    double left = 0;   // J that the deepest crush leaves
};
/// The depth whose crushed volume takes the energy (J) at the body's crush pressure; at most three tenths of its
/// extent. Metal beside a round striker is dragged along: it counts as half of the depth wider.
CrushPlan plan_crush(const MetalView& metal, const Striker& striker, double energy);

/// So many depths along the sheet from what the striker pushes, a field ends.
inline constexpr double kCrushReach = 2.5;
/// Fills MetalVertices.field: the smoothest one that leaves nothing inside the striker, and ends `reach` m away.
void raise_body(const MetalView& metal, const Striker& striker, double depth, double reach);

}  // namespace cullet
