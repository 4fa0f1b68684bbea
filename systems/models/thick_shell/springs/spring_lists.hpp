// Padded neighbour lists: each spring stands in the list of both its ends, 8 vertices to a pack.
#pragma once
#include "systems/models/thick_shell/springs/spring_view.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {

/// Springs of one vertex, by rising row: relative rows.
struct VertexSprings {
    uint32_t count = 0;
    uint32_t spring[kMostRing + 1];
    /// False: more than the list holds.
    bool add(uint32_t s);
};

/// The spring of an edge of an element: `other` has the edge as well, or kNone.
void name_spring(const SpringView& view, uint32_t element, uint32_t edge, uint32_t other, uint32_t spring);
/// Springs of the edges at a vertex, found over neighbour links.
void collect_springs(const SpringView& view, uint32_t vertex, VertexSprings& list);

/// Slots that the pack needs: the longest of its lists.
uint32_t slots_needed(const VertexSprings (&lists)[kLanes]);
/// Writes the pack's slots from its lists and Springs.length, tells the springs their places. The pack has the room.
void write_pack(const SpringView& view, uint32_t pack, const VertexSprings (&lists)[kLanes]);
/// Writes what the slots of both ends say about the spring's rest, stiffness and damping: after these have changed
/// (plastic flow, softening). Lengths that the slots remember stay.
void write_spring(const FlowingView& view, uint32_t spring);
void write_spring(const SpringView& view, uint32_t spring);
/// Springs.length of a spring from its slots; from where its ends are now when it has no place yet.
void remember_length(const SpringView& view, uint32_t spring);
/// Puts the lengths of all slots and twins to what the positions say: no spring is closing.
void measure_lengths(const SpringView& view);

}  // namespace cullet
