// Springs after the shell was cut, split or re-meshed.
#pragma once
#include <span>

#include "systems/springs/spring_view.hpp"

namespace cullet {

/// Makes the springs round `touched` (both halves of every split vertex, ends of cut edges, corners of new elements)
/// what the elements are now. An edge that was cut becomes two springs with the same lengths at rest and now, each with
/// k from its own triangles (C3.5); masses are summed anew from the rings, internal springs evaluated anew. A spring
/// that no element has any more is given no stiffness. False when there is no room for the new rows, and nothing has
/// changed. O(touched), whatever the shell's size, up to 512 vertices; more, and all of it is rebuilt.
bool rebuild_springs(const SpringView& view, std::span<const uint32_t> touched);

/// The element was re-meshed: its corners are not those that its springs were made for. rebuild_springs makes new ones
/// at their length at rest, except along edges whose other element still has one.
void forget_springs(const SpringView& view, uint32_t element);

}  // namespace cullet
