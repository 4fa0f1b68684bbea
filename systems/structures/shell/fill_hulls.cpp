#include "systems/hulls/extreme_points.hpp"
#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/systems.hpp"

namespace cullet {

namespace {

void make_shape(const State& state, const RigidWorld& rigid, uint32_t shape, uint32_t first, uint32_t count) {
    Vec3 points[kMostHullPoints];
    for (uint32_t p = 0; p < count; ++p) points[p] = state.hull_points.point[first + p];
    if (count > 0) rigid.make_shape(shape, {points, count});
}

}  // namespace

void fill_hulls(Each<HullWanted> wanted, ShellTables shells, const RigidWorld& rigid) {
    State& state = shells.state;
    const Row<Shells> shell = wanted->shell;
    uint32_t from = state.shells.points[shell].first;
    if (wanted->cell == kNone)
        return make_shape(state, rigid, kMostCellParts * state.shells.made_shape[shell], from,
                          state.shells.shape_points[shell]);
    choose_hull(ShellView(state, shell), wanted->cell);
    const uint32_t cell = state.shells.cells[shell].first + wanted->cell;
    from += state.cells.first_point[cell];
    for (uint32_t part = 0; part < kMostCellParts; ++part) {
        const uint32_t count = state.cells.part_points[cell][part];
        make_shape(state, rigid, kMostCellParts * state.cells.shape[cell] + part, from, count);
        from += count;
    }
}

}  // namespace cullet
