// What a cut may do to a mesh (thick shell note C5, section 8).
#pragma once
#include <cstdint>

namespace cullet {

/// Edges that are opened from one vertex at once: the star of a start.
inline constexpr uint32_t kMostArms = 6;

/// Part of an edge's length near its ends where a crack takes the end instead of a new vertex. Everyday 0.2 to 0.3.
/// Doubled (0.5), nothing is ever inserted and cracks follow the mesh's edges.
inline constexpr float kSnap = 0.25f;
/// Least 2 A / longest^2 of a new triangle (equilateral 0.87) and least area over the mean. Doubled, most inserts are
/// refused and cracks kink; halved, slivers shrink the stable time step's reserve.
inline constexpr float kLeastShape = 0.22f, kLeastArea = 0.12f;
/// Area of an equilateral triangle of edge 1: what "mean area" means on graded and re-meshed shells.
inline constexpr float kEquilateralArea = 0.433f;

}  // namespace cullet
