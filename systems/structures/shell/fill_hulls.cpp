#include "systems/hulls/extreme_points.hpp"
#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/structures/shell/systems.hpp"

namespace cullet {

namespace {

void make_shape(const ShellRows& state, const RigidWorld& rigid, uint32_t shape, uint32_t first, uint32_t count) {
    Vec3 points[kMostHullPoints];
    for (uint32_t p = 0; p < count; ++p) points[p] = state.hull_points.point[first + p];
    if (count > 0) rigid.make_shape(shape, {points, count});
}

}  // namespace

void fill_hulls(Each<HullWanted> wanted, ShellRows& rows, Tables<const MetalOwners, const MetalShells> metal,
                const RigidWorld& rigid) {
    const Row<Structures> shell = wanted->structure;
    uint32_t from = rows.structures.points[shell].first;
    if (wanted->cell == kNone)
        return make_shape(rows, rigid, kMostCellParts * rows.structures.made_shape[shell], from,
                          rows.structures.shape_points[shell]);
    if (is_shell(rows.structures, shell))
        choose_hull(ShellView(rows, shell), wanted->cell, sheet_of({rows, metal}, shell));
    const uint32_t cell = rows.structures.cells[shell].first + wanted->cell;
    from += rows.cells.first_point[cell];
    for (uint32_t part = 0; part < kMostCellParts; ++part) {
        const uint32_t count = rows.cells.part_points[cell][part];
        make_shape(rows, rigid, kMostCellParts * rows.cells.shape[cell] + part, from, count);
        from += count;
    }
}

}  // namespace cullet
