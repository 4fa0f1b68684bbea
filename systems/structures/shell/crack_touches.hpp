// Where the parts of a broken shell lie at each other: the faces of the cracks between them.
#pragma once
#include <span>

#include "components/shell_rows.hpp"
#include "engine/arena.hpp"
#include "systems/hulls/stop_approach.hpp"

namespace cullet {

/// Four touches a crack edge that lies between two parts, at its ends, on the outer and on the inner face, in body
/// axes; a and b are parts. What does not close at the ends closes nowhere between them, however the two turn. The
/// normal is that of the crack's face as it is drawn, since cracks zigzag with the mesh. `is_local` looks only at cells
/// that the run changed (Cells::is_stale). Edges are matched by where they are: both sides have the same rest
/// positions. O(n log n) of the free edges that are cracks. None when the arena is full.
std::span<Touch> crack_touches(ShellView shell, bool is_local, Arena& arena);

}  // namespace cullet
