// Which elements still hang together: components over neighbour links.
#pragma once
#include <span>

#include "components/state.hpp"

namespace cullet {

/// Writes Elements.part (0, 1, ... by smallest element; kNone for dead ones) and Elements.next, and describes the
/// parts. Returns how many there are. When `parts` is shorter, the parts beyond it are numbered but not described, and
/// their elements not chained. O(elements), no scratch.
uint32_t group_fragments(ShellView shell, std::span<FragmentPart> parts);

/// Row of the heaviest part, ties to the lower.
uint32_t largest_part(std::span<const FragmentPart> parts);

}  // namespace cullet
