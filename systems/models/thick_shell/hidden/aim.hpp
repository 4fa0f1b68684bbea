// The edge that a crack takes when it leaves a vertex in some direction.
#pragma once
#include "systems/structures/shell/insert_vertex.hpp"

namespace cullet {

struct Aim {
    uint32_t end = kNone;   // vertex at the other end of an interior edge, or kNone: no edge can be cut that way
    bool was_full = false;  // an insertion was refused because the shell has no room
    bool was_inserted = false;
};

/// Finds the triangle of the ring that `direction` enters and tau on its opposite edge (p, q), both in the plane of
/// `normal`. tau < 0.25 or > 0.75 takes the edge to p or q; else a vertex is put at tau, when `can_insert` allows it;
/// else the nearer of p and q, else the other one. An edge that is no longer interior cannot be taken, nor one that
/// turns by more than 60 degrees from the direction. Besides the insertion nothing changes, and edges at the vertex
/// stay, so that several directions can be aimed at before the first cut.
Aim aim(ShellView shell, uint32_t vertex, Vec3 normal, Vec3 direction, Touched& touched);

}  // namespace cullet
