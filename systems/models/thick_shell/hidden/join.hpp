// Cracks that come near each other meet.
#pragma once
#include "components/shell_rows.hpp"

namespace cullet {

/// The crack vertex that a tip should turn to. It is within 1.5 l of where its next step of length `step` in unit
/// `direction` would end, at most 60 degrees off that direction and with a normal within 60 degrees. Its own crack is
/// ignored while the tip is within 3 l of its root, or the arms of a star would close at once. The nearest to the
/// step's end, then the lowest vertex; kNone when there is none. One pass over the crack flags, a byte a vertex.
/// Without joining, cracks end as dead ends and give half the pieces.
uint32_t find_crack_ahead(ShellView shell, uint32_t tip, Vec3 direction, float step);

/// Bans starts within 3 l of this place for the rest of the run.
void ban_starts(ShellView shell, Vec3 place);
/// The same until this time of the run, for vertices without a crack (see may_start).
void ban_starts(ShellView shell, Vec3 place, float until);

}  // namespace cullet
