#include "systems/structures/tetrahedra/solid_pieces.hpp"

#include "systems/structures/tetrahedra/skin.hpp"
#include "systems/structures/tetrahedra/solid_hulls.hpp"

namespace cullet {
namespace {

uint32_t next_row(Range& range, [[maybe_unused]] const char* name) {
    CULLET_ASSERT(range.count < range.capacity, "%u rows of %s are too few for a piece", range.capacity, name);
    return range.first + range.count++;
}

void add_skin(SolidRows rows, const BrokenSolid& broken, const BrokenPiece& piece, Row<Solids> solid) {
    Range &points = rows.solids.points[solid], &triangles = rows.solids.triangles[solid];
    const uint32_t before = points.count;
    for (const Vec3d& place : piece.points.of(broken.points)) {
        const uint32_t row = next_row(points, "skin_points");
        rows.skin_points.place.set(row, place);
        rows.skin_points.tetrahedron[row] = kNone;
    }
    for (const BrokenTriangle& t : piece.triangles.of(broken.triangles)) {
        const uint32_t row = next_row(triangles, "skin_triangles");
        rows.skin_triangles.corners[row] = {t.corners[0] + before, t.corners[1] + before, t.corners[2] + before};
        rows.skin_triangles.normals[row] = t.normals;
        rows.skin_triangles.uv[row] = t.uv;
        rows.skin_triangles.drawn_material[row] = t.drawn_material;
        rows.skin_triangles.is_inside[row] = t.is_inside;
    }
}

}  // namespace

SolidRoom room_for_pieces(const BrokenSolid& broken, std::span<const BrokenPiece> pieces) {
    SolidRoom room;
    room.moved = static_cast<uint32_t>(broken.moved.size());
    for (const BrokenPiece& piece : pieces) {
        room.members += piece.cells.count;
        room.points += piece.points.count;
        room.triangles += piece.triangles.count;
        room.cells += piece.hulls.count;
        room.hull_points += piece.hull_points.count;
    }
    return room;
}

void copy_structure(Structures& s, Row<Structures> from, Row<Structures> to) {
    const uint32_t own = s.rows[to], users = s.users[to];
    const Range cells = s.cells[to], points = s.points[to];
    s.copy_rows(s, from, to, 1);
    s.rows[to] = own, s.users[to] = users;
    s.cells[to] = cells, s.points[to] = points;
}

void fill_solid(SolidRows rows, const BrokenSolid& broken, uint32_t piece, Row<Structures> structure) {
    Structures& structures = rows.structures;
    const Row<Solids> solid = solid_of(structures, structure);
    for_each_solid_range(rows, structure, {}, [](Range& range, auto&, uint32_t, const char*) { range.count = 0; });
    rows.solids.is_whole[solid] = 0;
    for (uint32_t i = 0; i < broken.moved.size(); ++i) {
        const uint32_t row = next_row(rows.solids.moved[solid], "moved_nodes");
        rows.moved_nodes.node[row] = broken.moved[i];
        rows.moved_nodes.place.set(row, broken.moved_to[i]);
    }
    for (uint32_t p = 0; p < broken.pieces.size(); ++p) {
        const BrokenPiece& of = broken.pieces[p];
        if (of.one_with != piece) continue;
        for (const uint32_t cell : of.cells.of(broken.cells)) {
            const uint32_t row = next_row(rows.solids.members[solid], "solid_members");
            rows.solid_members.cell[row] = cell;
            rows.solid_members.piece[row] = p;
        }
        add_skin(rows, broken, of, solid);
        add_hulls(rows, structure, of.hulls.of(broken.hulls), of.hull_points.of(broken.hull_points));
    }
    structures.live_elements[structure] = rows.solids.members[solid].count;
    structures.has_cracks[structure] = 0;
    measure_solid(rows, structure);
}

void give_back_spare(SolidRows rows, Row<Structures> structure) {
    for_each_solid_range(rows, structure, {}, [](Range& range, auto& table, uint32_t, const char*) {
        table.pool.give_back(range.first + range.count, range.capacity - range.count);
        range.capacity = range.count;
    });
}

}  // namespace cullet
