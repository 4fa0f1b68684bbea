#include "systems/bodies/thresholds.hpp"
#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/piece_shape.hpp"
#include "systems/structures/shell/rest_of_body.hpp"
#include "systems/structures/shell/vertex_sums.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

void want_hulls(ShellRows& state, Row<Structures> shell, Events<HullWanted>& wanted) {
    Cells& cells = state.cells;
    const Range range = state.structures.cells[shell];
    if (shape_of(ShellView(state, shell)) != ShapeKind::Cells) {
        state.structures.made_shape[shell] = wanted.size();
        wanted.push({shell, kNone});
        return;
    }
    for (uint32_t c = 0; c < range.count; ++c) {
        const uint32_t row = range.first + c;
        const bool is_wanted = cells.same_cell[row] == kNone;
        cells.shape[row] = is_wanted ? wanted.size() : kNone;
        if (is_wanted) wanted.push({shell, c});
    }
}

// The smaller sides have moved (design section 3): the rest keeps its rows, those of the pieces are dead. What rows the
// body had before tell which hulls are as they were. Children first: their hulls are found among the body's.
void keep_rest(BodyRows& state, const Break& plan) {
    const ShellView shell(state, plan.broken), before(state, plan.before);
    ShellSums left;
    for (uint32_t p = 0; p < plan.parts.size(); ++p) {
        if (!plan.leaves(p)) continue;
        outdate_blocks(shell, plan.parts[p]);
        if (plan.child[p].exists()) {
            const ShellView piece(state, state.bodies.structure[plan.child[p]]);
            if (shape_of(piece) == ShapeKind::Cells)
                copy_piece_hulls(piece, before, plan.margin, plan.had_cells);
            else
                empty_piece_cells(piece);
            left = left + sums_of(piece);
            continue;
        }
        for (uint32_t e = plan.parts[p].first_element; e != kNone; e = state.elements.next[shell.element(e)])
            left = left + element_sums(shell, e);
    }
    if (!plan.is_rest_smaller(state)) write_sums(shell, plan.whole - left);
    state.shells.dead_elements[shell.row] += plan.left_elements;
    state.structures.live_elements[shell.structure] -= plan.left_elements;
    uint8_t& generation = state.structures.generation[shell.structure];
    if (generation < kMostGenerations) ++generation;
    if (!plan.is_torn) clear_run(shell, false, plan.broken != plan.before, plan.is_refused);
    if (plan.keeps_hulls) return renew_rest_hulls(shell);
    const Range points = state.structures.points[before.structure],
                old_points = state.structures.points[shell.structure];
    state.structures.points[shell.structure] = plan.points;
    if (shape_of(shell) != ShapeKind::Cells && plan.chooses_shape)
        empty_rest_cells(shell);
    else
        copy_rest_hulls(shell, points, before, plan.had_cells);
    state.hull_points.pool.give_back(old_points.first, old_points.capacity);
    adopt_shell(state, plan.body, shell.structure);
}

}  // namespace

void plan_hulls(Serial, const Events<Break>& breaks, BodyRows& rows, RigidWorld& rigid, Events<HullWanted>& wanted) {
    wanted.clear();
    if (breaks.size() == 0) return;
    for (const Break& plan : breaks) {
        keep_rest(rows, plan);
        want_hulls(rows, plan.broken, wanted);
        for (const Row<Bodies> child : plan.child)
            if (child.exists()) want_hulls(rows, rows.bodies.structure[child], wanted);
    }
    rigid.reserve_shapes(kMostCellParts * wanted.size());
}

}  // namespace cullet
