#include <algorithm>

#include "systems/bodies/rigid_shape.hpp"
#include "systems/structures/shell/costs.hpp"
#include "systems/structures/shell/draw_shell.hpp"
#include "systems/structures/shell/group_fragments.hpp"
#include "systems/structures/shell/make_piece.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/rest_of_body.hpp"
#include "systems/structures/shell/systems.hpp"

namespace cullet {
namespace {

// A row that is free says nothing of a shell: it is all zeros, and shell 0 is somebody else's.
bool is_worth_it(const BodyRows& state, uint32_t b) {
    const Bodies& bodies = state.bodies;
    if (static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Free) return false;
    const Row<Structures> shell = bodies.structure[b];
    // Springs would have to move, too; they stay with a shell of its first size.
    if (!shell.exists() || bodies.task[b] != kNone || bodies.is_owed_births[b]) return false;
    if (!is_shell(state.structures, shell)) return false;
    const Row<Shells> row = state.shell_of(shell);
    return 4 * uint64_t{state.shells.dead_elements[row]} > state.shells.elements[row].count &&
           !state.shells.springs[row].exists();
}

// The drawn mesh names elements by the rows that they have now.
void follow_drawn(BodyRows& state, Row<Bodies> body, ShellView old, ShellView now) {
    const Range drawn = state.bodies.view_indices[body];
    for (uint32_t i = drawn.first; i < drawn.first + drawn.count; ++i) {
        uint32_t& source = state.view_indices.source[i];
        const uint32_t e = source / kMostDrawnTriangles;
        source = kMostDrawnTriangles * state.elements.copy[old.element(e)] + source % kMostDrawnTriangles;
    }
    remember_drawn(now, state.view_indices, drawn);
}

bool compact(BodyRows& state, MetalTables metal, Row<Bodies> body, std::span<FragmentPart> slot) {
    const Row<Structures> old = state.bodies.structure[body];
    if (group_fragments(ShellView(state, old), slot) != 1) return false;
    const Row<Structures> compacted = compact_shell({state, metal}, old, slot[0]);
    if (!compacted.exists()) return false;
    follow_drawn(state, body, ShellView(state, old), ShellView(state, compacted));
    release_metal_shell({state, metal}, old);
    state.bodies.structure[body] = compacted;
    take_mass_properties(state.bodies, state.structures, body,
                         radius_of(ShellView(state, state.bodies.structure[body])));
    return true;
}

}  // namespace

// The drawn mesh and the hulls stay: nothing that the game or the rigid world sees changes, but the last bits of the
// mass. The first body of a quiet frame is served even when it costs more than the budget, or it never would be.
void compact_shells(Serial, BodyRows& rows, MetalTables metal, DamageCounts& counts, const Events<TaskEnded>& ended) {
    bool is_quiet = ended.size() == 0;
    for (uint32_t t = 0; t < rows.tasks.size() && is_quiet; ++t)
        is_quiet = static_cast<TaskState>(rows.tasks.state[t]) == TaskState::Free;
    if (!is_quiet) return;
    const std::span<FragmentPart> slot = rows.shell_parts.of_none();
    bool is_first = true;
    for (uint32_t b = 0; b < rows.bodies.size(); ++b) {
        if (!is_worth_it(rows, b)) continue;
        const Row<Structures> shell = rows.bodies.structure[b];
        const uint64_t live = rows.structures.live_elements[shell];
        const uint64_t cost = kUnitsCompact * live;
        if (!is_first && cost > counts.units_left) return;
        if (!compact(rows, metal, Row<Bodies>(b), slot)) continue;
        is_first = false;
        counts.units_left -= std::min(cost, counts.units_left);
        counts.units_used += cost;
    }
}

}  // namespace cullet
