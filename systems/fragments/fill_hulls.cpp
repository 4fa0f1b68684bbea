#include "systems/fragments/cell_hulls.hpp"
#include "systems/fragments/extreme_points.hpp"
#include "systems/systems.hpp"

namespace cullet {

void fill_hulls(Each<HullWanted> wanted, ShellTables shells, const RigidWorld& rigid) {
    State& state = shells.state;
    choose_hull(ShellView(state, wanted->shell), wanted->cell);
    const uint32_t cell = state.shells.cells[wanted->shell].first + wanted->cell;
    uint32_t from = state.shells.points[wanted->shell].first + state.cells.first_point[cell];
    for (uint32_t part = 0; part < kMostCellParts; ++part) {
        Vec3 points[kMostHullPoints];
        const uint32_t count = state.cells.part_points[cell][part];
        for (uint32_t p = 0; p < count; ++p) points[p] = state.hull_points.point[from++];
        if (count > 0) rigid.make_shape(kMostCellParts * state.cells.shape[cell] + part, {points, count});
    }
}

}  // namespace cullet
