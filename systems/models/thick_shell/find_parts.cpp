#include "systems/models/thick_shell/hidden/run_out.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/systems.hpp"
#include "systems/structures/shell/flood_parts.hpp"

namespace cullet {

// A mesh of several parts, which nothing but the rigid body held together, comes apart at the first hit that is worth a
// task, cracked or not.
//
// A cut may leave a body that stood on pins in one piece without any: it falls.
void find_parts(EachOwn<TaskEnded> ended, BodyRows& rows) {
    const uint32_t t = ended->task;
    rows.tasks.part_count[t] = 1;
    if (static_cast<TaskState>(rows.tasks.state[t]) == TaskState::Dropped) return;
    const ShellView shell(rows, rows.tasks.working[t]);
    const bool is_zero = is_numbered_zero(shell), was_one = is_zero || is_of_one_part(shell),
               is_quick = is_quick_task(rows, t);
    if (rows.tasks.crack_count[t] == 0 && was_one) return;
    const std::span<FragmentPart> parts = rows.shell_parts.of_task(t);
    // A body that may have been hit on a cut-out is not looked at as a whole; cracks that run out want the scratch that
    // a flood uses.
    const uint32_t vertices =
        rows.shells.vertices[rows.shell_of(rows.tasks.source[t])].count;  // before the cracks brought theirs
    // A hidden run's cracks have run out in its cut-out.
    const bool was_hidden_region = rows.tasks.working[t] == rows.tasks.source[t] && !is_quick;
    const bool runs_out = is_quick ? vertices <= kWholeCopyVertices : !was_hidden_region;
    const uint32_t most = worthwhile_floods(shell);
    rows.tasks.part_count[t] = kNone;
    if (!runs_out && is_zero) rows.tasks.part_count[t] = find_pieces(shell, parts, most);
    if (rows.tasks.part_count[t] == kNone) {
        rows.tasks.part_count[t] =
            was_one && !runs_out ? group_from_cracks(shell, parts, most) : group_fragments(shell, parts);
    }
    if (rows.tasks.part_count[t] > 1 && runs_out && run_out_cracks(rows, Row<Tasks>(t)))
        rows.tasks.part_count[t] = group_fragments(shell, parts);
    const bool lets_go =
        rows.tasks.part_count[t] == 1 && rows.bodies.has_pins[rows.tasks.body[t]] && !parts[0].has_pins;
    if (rows.tasks.part_count[t] > 1 || lets_go) rows.tasks.state[t] = static_cast<uint8_t>(TaskState::Broke);
    if (rows.tasks.part_count[t] > kMostParts) rows.tasks.state[t] = static_cast<uint8_t>(TaskState::Dropped);
}

}  // namespace cullet
