#include "systems/fragments/cell_hulls.hpp"
#include "systems/systems.hpp"

namespace cullet {

void fill_hulls(Each<HullWanted> wanted, ShellTables shells, const RigidWorld& rigid) {
    State& state = shells.state;
    choose_hull(ShellView(state, wanted->shell), wanted->cell);
    const uint32_t cell = state.shells.cells[wanted->shell].first + wanted->cell;
    Vec3 points[kMostHullPoints];
    const uint32_t count = state.cells.point_count[cell];
    const uint32_t first = state.shells.points[wanted->shell].first + state.cells.first_point[cell];
    for (uint32_t p = 0; p < count; ++p) points[p] = state.hull_points.point[first + p];
    if (count > 0) rigid.make_shape(state.cells.shape[cell], {points, count});
}

}  // namespace cullet
