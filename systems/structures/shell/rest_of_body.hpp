// What stays of a body when its smaller sides have moved: the rows stand where they stood, those of the moved pieces
// are dead until the shell is compacted.
#pragma once
#include <span>

#include "components/body_rows.hpp"
#include "components/metal_rows.hpp"
#include "systems/structures/shell/group_fragments.hpp"

namespace cullet {

/// A hit on a shell of more vertices works on a cut-out of it: a whole copy of so many rows takes 0.4 ms.
inline constexpr uint32_t kWholeCopyVertices = 4000;

/// Marks elements, vertices and hinges of a part dead, on any thread: no other part has them. The part's list of
/// elements stays readable; dead_elements is the caller's affair. O(the part).
void shed_part(ShellView shell, const FragmentPart& part);

/// After the last shed_part: has_cracks, marks of cracks that pieces took with them, velocities, and the state of a
/// hidden run, if one was made on these rows: all of that is cleared. Fragments (`is_whole` false) count as cracked
/// while a tip is left. Velocities of pieces that wait stay. O(the shell's vertices).
void clear_run(ShellView shell, bool is_whole, bool has_run = true, bool has_waiting = false);
/// The velocities that put_back wrote are cleared, as clear_run does it where no run was made on these rows.
void stop_blocks(ShellView shell);

/// Mass properties, area and thickness of the shell, summed over its one part that will be left.
void measure_part(ShellView shell, const FragmentPart& part);

/// The body's own shell is `shell` from here on, without the stiffness rows that only a task needs.
void adopt_shell(BodyRows& state, MetalTables metal, Row<Bodies> body, Row<Structures> shell);

/// Hull points of `before` for a shell with the same cells that only cracked: hulls stay as they are, and the cells
/// that cracks touched (find_changed_cells) are chosen anew at the next break. False: no room.
bool keep_hulls(ShellView shell, ShellView before);

}  // namespace cullet
