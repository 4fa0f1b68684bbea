// A vertex split in two along a plane (thick shell note C3, plane form; C5, general re-meshing). All in the rest shape.
#pragma once
#include "systems/structures/shell/cut_ends.hpp"

namespace cullet {

/// Which side of the plane each element of a ring goes to.
struct RingSides {
    bool is_above[kMostRing];
    bool is_split = false;    // both sides have some, in two runs round a cycle or along a chain
    bool was_mended = false;  // there were more runs: the two were chosen that put the least area on the wrong side
};
/// By the sign of normal . (centroid - place of the vertex). A centroid within 1e-6 mean edges of the plane goes with
/// its larger neighbour in the ring, and above where both are on it.
RingSides choose_sides(ShellView shell, uint32_t vertex, const Ring& ring, Vec3 normal);

/// Ends of the edges between the sides: two of a cycle, one of a chain.
Ends ends_between(ShellView shell, const Ring& ring, const RingSides& sides);

/// An edge opposite to a vertex that a plane through it crosses.
struct PlaneCrossing {
    uint32_t element = kNone, edge = 0;  // kNone: there is none (left)
    float tau = 0;                       // from the edge's first corner
    bool is_full = false;                // one was passed over because the shell has no room
};
/// Of the ring's far edges that the plane crosses farther than a fifth from both ends the one of least (lower end,
/// higher end), if a vertex may be put there. The edge must be no crack, and no ring too large. No new triangle may
/// have an angle below 15 degrees, or less than 0.05 of the area of the one that it is part of, or of the cooked mesh's
/// mean one. After insert_vertex, ask again.
PlaneCrossing find_plane_crossing(ShellView shell, uint32_t vertex, Vec3 normal);

}  // namespace cullet
