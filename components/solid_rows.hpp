// What solids are made of: what was cooked, which many of them share, and what a piece has to itself.
#pragma once
#include "components/structure_rows.hpp"
#include "components/tetrahedra.hpp"

namespace cullet {

/// Of solids, all of them together. A solid of 1,500 cells has about 8,000 tetrahedra, 1,500 coarse ones if they are
/// cut in 8, and 2,000 points.
inline uint32_t lattice_limit(const Limits& l) {
    return l.elements / 2;
}
inline uint32_t cooked_limit(const Limits& l) {
    return l.models + l.tasks;
}

struct TablesOfSolids {
    Limits limits;
    CookedSolids cooked_solids{cooked_limit(limits), cooked_limit(limits)};
    LatticeNodes lattice_nodes{lattice_limit(limits), cooked_limit(limits)};
    PointWindings point_windings{lattice_limit(limits), cooked_limit(limits)};
    Tetrahedra tetrahedra{lattice_limit(limits), cooked_limit(limits)};
    CoarseTetrahedra coarse_tetrahedra{lattice_limit(limits) / 4, cooked_limit(limits)};
    SolidCellRows solid_cells{lattice_limit(limits) / 2, cooked_limit(limits)};
    RawCellRows raw_cells{lattice_limit(limits), cooked_limit(limits)};
    SolidMoments solid_moments{lattice_limit(limits), cooked_limit(limits)};
    SolidBondRows solid_bonds{lattice_limit(limits), cooked_limit(limits)};
    SolidPatches solid_patches{lattice_limit(limits), cooked_limit(limits)};
    MeshTriangles mesh_triangles{lattice_limit(limits), cooked_limit(limits)};
    Solids solids{limits.structures, limits.structures};
    SolidMembers solid_members{lattice_limit(limits) / 2, limits.structures};
    MovedNodes moved_nodes{lattice_limit(limits) / 2, limits.structures};
    SkinPoints skin_points{limits.vertices, limits.structures + cooked_limit(limits)};
    SkinTriangles skin_triangles{limits.elements, limits.structures + cooked_limit(limits)};
};
/// What follows from what was cooked, and what breaks work in: no state, made again where it is missing. None until
/// something may break.
struct SolidWork {
    std::shared_ptr<SolidRooms> rooms;

    static constexpr bool kIsWorkingMemory = true;  // for systems
    CULLET_NAMED(solid_work);
};

/// What was cooked.
using CookedTables = Tables<CookedSolids, LatticeNodes, PointWindings, Tetrahedra, CoarseTetrahedra, SolidCellRows,
                            RawCellRows, SolidMoments, SolidBondRows, SolidPatches, MeshTriangles>;
/// A structure that is a solid reaches these tables and no others.
using SolidRows = All<const Materials, Structures, Cells, HullPoints, CookedTables, Solids, SolidMembers, MovedNodes,
                      SkinPoints, SkinTriangles, SolidWork>;

/// Rows that a cooked solid needs.
struct CookedRoom {
    uint32_t lattice_points = 0, tetrahedra = 0, coarse = 0, windings = 0, cells = 0, moments = 0, bonds = 0;
    uint32_t patches = 0, points = 0, triangles = 0, raw = 0;
};
/// Calls f(range, table, rows wanted, limit) for each table of which a cooked solid has a range.
template <class Rows, class F>
void for_each_cooked_range(Rows& rows, Row<CookedSolids> row, const CookedRoom& room, F&& f) {
    auto& own = rows.cooked_solids;
    f(own.lattice_points[row], rows.lattice_nodes, room.lattice_points, "limits.elements");
    f(own.tetrahedra[row], rows.tetrahedra, room.tetrahedra, "limits.elements");
    f(own.coarse[row], rows.coarse_tetrahedra, room.coarse, "limits.elements");
    f(own.windings[row], rows.point_windings, room.windings, "limits.elements");
    f(own.cells[row], rows.solid_cells, room.cells, "limits.elements");
    f(own.raw[row], rows.raw_cells, room.raw, "limits.elements");
    f(own.moments[row], rows.solid_moments, room.moments, "limits.elements");
    f(own.bonds[row], rows.solid_bonds, room.bonds, "limits.elements");
    f(own.patches[row], rows.solid_patches, room.patches, "limits.elements");
    f(own.points[row], rows.skin_points, room.points, "limits.vertices");
    f(own.triangles[row], rows.skin_triangles, room.triangles, "limits.elements");
    f(own.mesh_triangles[row], rows.mesh_triangles, room.triangles, "limits.elements");
}
/// Rows that a structure has to itself when it is a solid. A whole one has none of them.
struct SolidRoom {
    uint32_t members = 0, moved = 0, points = 0, triangles = 0;  // solid_members ... skin_triangles
    uint32_t cells = 0, hull_points = 0;                         // of Structures
};
/// The same for the row of a structure.
template <class Rows, class F>
void for_each_solid_range(Rows& rows, Row<Structures> structure, const SolidRoom& room, F&& f) {
    auto& own = rows.solids;
    const Row<Solids> row(rows.structures.rows[structure]);
    f(own.members[row], rows.solid_members, room.members, "limits.elements");
    f(own.moved[row], rows.moved_nodes, room.moved, "limits.elements");
    f(own.points[row], rows.skin_points, room.points, "limits.vertices");
    f(own.triangles[row], rows.skin_triangles, room.triangles, "limits.elements");
    f(rows.structures.cells[structure], rows.cells, room.cells, "limits.vertices");
    f(rows.structures.points[structure], rows.hull_points, room.hull_points, "limits.vertices");
}
/// A row with empty ranges of these capacities and no user; kNone when some table is full.
Row<CookedSolids> make_cooked(SolidRows rows, const CookedRoom& room, const char** full = nullptr);
CookedRoom room_of(Read<SolidRows> rows, Row<CookedSolids> cooked);
/// A structure of one user that has what was cooked; kNone when some table is full. What its rows hold is the caller's
/// affair.
Row<Structures> make_solid(SolidRows rows, Row<CookedSolids> cooked, const SolidRoom& room,
                           const char** full = nullptr);
SolidRoom solid_room_of(Read<SolidRows> rows, Row<Structures> structure);
/// One user less; the rows go back when there are none, and those of what was cooked with the last that has it.
void release_solid(SolidRows rows, Row<Structures> structure);
/// A copy of what the same or another state holds, with one user; in the same state it shares what was cooked.
Row<Structures> import_solid(SolidRows to, Read<SolidRows> from, Row<Structures> source, const char** full);

/// The row of a structure that is a solid.
inline Row<Solids> solid_of(const Structures& structures, Row<Structures> structure) {
    return Row<Solids>(structures.rows[structure]);
}

}  // namespace cullet
