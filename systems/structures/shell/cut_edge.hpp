// Opens one interior edge.
#pragma once
#include "systems/structures/shell/ring.hpp"

namespace cullet {

/// Edge `edge` of `element` becomes a crack on both of its sides and its hinge dies. Vertices stay as they are: a
/// vertex whose ring falls into more than one fan by this must be given to `split_fans` before its ring is walked
/// again. False, and nothing changed, when no element lies across.
bool cut_edge(ShellView shell, uint32_t element, uint32_t edge);

/// Edge of `element` that runs from vertex `from` to vertex `to`, or 3.
uint8_t edge_between(ShellView shell, uint32_t element, uint32_t from, uint32_t to);

}  // namespace cullet
