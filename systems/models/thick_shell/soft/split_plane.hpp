// The plane form of a vertex split (thick shell note C3), on cut edges and fans.
#pragma once
#include "systems/models/thick_shell/springs/spring_view.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {

inline constexpr uint32_t kMostSplitTouched = 16;

/// What a split changed: the vertex, its copy, the ends of the cut edges, their copies.
struct PlaneSplit {
    bool is_done = false;
    bool has_closed = false;  // a crack met a border or another crack: a piece may have come off
    uint32_t touched_count = 0;
    uint32_t touched[kMostSplitTouched];
};

/// Splits vertex v along the plane through it with this normal, at the places that `view` has now. Elements of its ring
/// are signed by their centroids. Two runs of them are parted by the cut pair (a cycle) or single cut (a chain) with
/// the least area on the wrong side. So rings that are not convex are no special case. Ends that lay on a border or
/// crack are parted too, the others become tips. The mesh alone: springs and masses of the copies are rebuild_springs'
/// affair. Not done: one element, or no room for three vertices.
PlaneSplit split_plane(const SpringView& view, uint32_t vertex, Vec3 normal);

}  // namespace cullet
