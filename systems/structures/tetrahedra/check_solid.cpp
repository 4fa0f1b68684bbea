#include "systems/structures/tetrahedra/check_solid.hpp"

#include <algorithm>

namespace cullet {
namespace {

template <class Column>
bool are_below(const Range& range, const Column& column, uint32_t limit) {
    for (uint32_t r = range.first; r < range.first + range.count; ++r)
        if (!(column[r] < limit)) return false;
    return true;
}
template <class Column>
bool are_all_below(const Range& range, const Column& column, uint32_t limit) {
    for (uint32_t r = range.first; r < range.first + range.count; ++r)
        for (const uint32_t value : column[r])
            if (!(value < limit)) return false;
    return true;
}

bool are_windings_sound(Read<SolidRows> rows, const Range& points, uint32_t windings) {
    uint32_t next = 0;
    for (uint32_t r = points.first; r < points.first + points.count; ++r) {
        if (rows.lattice_nodes.first_winding[r] != next) return false;
        const uint32_t count = rows.lattice_nodes.winding_count[r];
        if (count > windings - next) return false;
        next += count;
    }
    return next == windings;
}

std::string trouble_of_cooked(Read<SolidRows> rows, Row<CookedSolids> row) {
    const CookedSolids& own = rows.cooked_solids;
    const Range points = own.lattice_points[row], tetrahedra = own.tetrahedra[row], coarse = own.coarse[row],
                cells = own.cells[row], skin = own.points[row], triangles = own.triangles[row],
                mesh = own.mesh_triangles[row];
    if (points.count == 0 || tetrahedra.count == 0 || cells.count == 0 || triangles.count == 0)
        return "was cooked to nothing";
    if (mesh.count != triangles.count) return "has other triangles to cut than to draw";
    if (!(own.edge[row] > 0) || !(own.volume[row] > 0) || !(own.area[row] > 0) || !(own.thickness[row] > 0))
        return "has no size";
    const bool are_named = are_all_below(tetrahedra, rows.tetrahedra.corners, points.count) &&
                           are_below(tetrahedra, rows.tetrahedra.coarse, coarse.count) &&
                           are_all_below(coarse, rows.coarse_tetrahedra.nodes, points.count) &&
                           are_below(cells, rows.solid_cells.tetrahedron, tetrahedra.count) &&
                           are_below(own.raw[row], rows.raw_cells.tetrahedron, tetrahedra.count) &&
                           are_below(own.raw[row], rows.raw_cells.cell, cells.count) &&
                           are_below(own.moments[row], rows.solid_moments.cell, cells.count) &&
                           are_below(own.moments[row], rows.solid_moments.coarse, coarse.count) &&
                           are_below(own.bonds[row], rows.solid_bonds.a, cells.count) &&
                           are_below(own.bonds[row], rows.solid_bonds.b, cells.count) &&
                           are_below(own.bonds[row], rows.solid_bonds.tetrahedron, tetrahedra.count) &&
                           are_below(own.bonds[row], rows.solid_bonds.face, 4) &&
                           are_below(own.patches[row], rows.solid_patches.triangle, triangles.count) &&
                           are_below(own.patches[row], rows.solid_patches.cell, cells.count) &&
                           are_all_below(triangles, rows.skin_triangles.corners, skin.count) &&
                           are_all_below(mesh, rows.mesh_triangles.sides, 3 * triangles.count) &&
                           are_below(mesh, rows.mesh_triangles.part, own.parts[row]) &&
                           are_below(own.windings[row], rows.point_windings.part, own.parts[row]) &&
                           own.parts[row] <= triangles.count;
    if (!are_named) return "names rows that it does not have";
    for (uint32_t r = cells.first; r < cells.first + cells.count; ++r)
        if (!(rows.solid_cells.volume[r] > 0)) return "has a cell of no volume";
    for (uint32_t r = skin.first; r < skin.first + skin.count; ++r)
        if (rows.skin_points.tetrahedron[r] != kNone && rows.skin_points.tetrahedron[r] >= tetrahedra.count)
            return "has a point in a tetrahedron that is not there";
    return are_windings_sound(rows, points, own.windings[row].count) ? "" : "has windings of other points";
}

std::string trouble_of_own(Read<SolidRows> rows, Row<Structures> structure) {
    const Row<Solids> row = solid_of(rows.structures, structure);
    const Solids& own = rows.solids;
    const Row<CookedSolids> cooked = own.cooked[row];
    const uint32_t cells = rows.cooked_solids.cells[cooked].count,
                   nodes = rows.cooked_solids.lattice_points[cooked].count;
    if (own.is_whole[row] > 1) return "is neither whole nor a piece";
    if (own.is_whole[row] && own.members[row].count + own.moved[row].count + own.points[row].count > 0)
        return "is whole and has rows of a piece";
    const bool are_named = are_below(own.members[row], rows.solid_members.cell, cells) &&
                           are_below(own.moved[row], rows.moved_nodes.node, nodes) &&
                           are_all_below(own.triangles[row], rows.skin_triangles.corners, own.points[row].count);
    if (!are_named) return "names rows that it does not have";
    const Range hulls = rows.structures.cells[structure];
    uint32_t next = 0;
    for (uint32_t c = hulls.first; c < hulls.first + hulls.count; ++c) {
        const uint32_t count = rows.cells.point_count[c];
        const auto& parts = rows.cells.part_points[c];
        if (rows.cells.first_point[c] != next || count > kMostCellPoints || count < 4 || parts[0] != count ||
            parts[1] + parts[2] + parts[3] > 0)
            return "has a hull of " + std::to_string(count) + " points";
        next += count;
    }
    if (next != rows.structures.points[structure].count) return "has points of no hull";
    const bool is_sound = rows.structures.shape[structure] == static_cast<uint8_t>(ShapeKind::Cells) &&
                          rows.structures.shape_points[structure] == 0;
    return is_sound ? "" : "is one hull, and has cells";
}

}  // namespace

std::string trouble_of_solid(Read<SolidRows> rows, Row<Structures> structure) {
    const std::string cooked = trouble_of_cooked(rows, rows.solids.cooked[solid_of(rows.structures, structure)]);
    return cooked.empty() ? trouble_of_own(rows, structure) : cooked;
}

}  // namespace cullet
