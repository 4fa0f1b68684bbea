// Springs after the shell was cut, split or re-meshed.
#pragma once
#include <span>

#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {

/// Makes the springs round `touched` (both halves of every split vertex, ends of cut edges, corners of new elements)
/// what the elements are now. An edge that was cut becomes two springs with the same lengths at rest and now, each with
/// k from its own triangles (C3.5); masses are summed anew from the rings, internal springs evaluated anew. False when
/// there is no room for the new rows, and nothing has changed. O(touched), whatever the shell's size, up to 512
/// vertices; more, and all of it is rebuilt.
bool rebuild_springs(const SpringView& view, std::span<const uint32_t> touched);

/// The element was re-meshed: its corners are not those that its springs were made for. To be called for each element
/// whose corners changed, before any vertex is split. An edge whose other element still has a spring keeps it. For the
/// rest rebuild_springs makes new ones at their length at rest, which have flowed as those of their elements had
/// (carry_flow.hpp). Rows that no element has are cleared: no ends, no stiffness.
void forget_springs(const SpringView& view, uint32_t element);
/// Springs of elements that left the shell with a piece: their rows are cleared. Slots of its vertices, which have no
/// mass any more, keep what they say until their pack is written anew.
void drop_dead_springs(const SpringView& view);
/// The inner point of a vertex that was put between p and q at (1 - tau) p + tau q: as all columns, place and velocity
/// of the inner points are interpolated (C5). Two layers only; rebuild_springs comes next.
void insert_twin(const SpringView& view, uint32_t p, uint32_t q, uint32_t vertex, float tau);

}  // namespace cullet
