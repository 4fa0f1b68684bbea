// Where the parts of a broken shell lie at each other: the faces of the cracks between them.
#pragma once
#include "components/fragments.hpp"
#include "components/shell_rows.hpp"
#include "engine/arena.hpp"

namespace cullet {

/// New rows, four a crack edge that lies between two parts, at its ends, on the outer and on the inner face, in body
/// axes; part p is fragment first + p. What does not close at the ends closes nowhere between them, however the two
/// turn. The normal is that of the crack's face as it is drawn, since cracks zigzag with the mesh. `is_local` looks
/// only at cells that the run changed (Cells::is_stale). Edges are matched by where they are: both sides have the same
/// rest positions. O(n log n) of the free edges that are cracks. None where there is no room, in the arena for the
/// edges or in the table.
Rows<Touches> crack_touches(ShellView shell, Row<Fragments> first, bool is_local, Touches& touches, Arena& arena);

}  // namespace cullet
