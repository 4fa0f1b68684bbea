#include "systems/structure_calls.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

void want_hulls(StructureRows& state, Row<Structures> structure, Events<HullWanted>& wanted) {
    Cells& cells = state.cells;
    const Range range = state.structures.cells[structure];
    if (shape_of(state.structures, structure) != ShapeKind::Cells) {
        state.structures.made_shape[structure] = wanted.size();
        wanted.push({structure, kNone});
        return;
    }
    for (uint32_t c = 0; c < range.count; ++c) {
        const uint32_t row = range.first + c;
        const bool is_wanted = cells.same_cell[row] == kNone;
        cells.shape[row] = is_wanted ? wanted.size() : kNone;
        if (is_wanted) wanted.push({structure, c});
    }
}

}  // namespace

void plan_hulls(Serial, const Events<Break>& breaks, const Fragments& fragments, WorldRows& rows, RigidWorld& rigid,
                Events<HullWanted>& wanted) {
    wanted.clear();
    if (breaks.size() == 0) return;
    for (const Break& plan : breaks) {
        calls_of(rows.structures, plan.broken).keep_rest(rows, plan, fragments);
        want_hulls(rows, plan.broken, wanted);
        for (const Row<Fragments> f : plan.fragments)
            if (const Row<Bodies> child = fragments.child[f]; child.exists())
                want_hulls(rows, rows.bodies.structure[child], wanted);
    }
    rigid.reserve_shapes(kMostCellParts * wanted.size());
}

}  // namespace cullet
