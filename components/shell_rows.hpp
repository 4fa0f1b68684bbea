// All rows that shells are made of, as one parameter. What edits, copies and measures shells reaches these tables and
// no others.
#pragma once
#include "components/limits.hpp"
#include "components/materials.hpp"
#include "components/metal.hpp"
#include "components/shell_parts.hpp"
#include "components/shells.hpp"
#include "components/springs.hpp"
#include "components/tetrahedra.hpp"
#include "components/vertex_blocks.hpp"
#include "engine/scratch.hpp"
#include "engine/system.hpp"

namespace cullet {

/// Rows that a shell needs. Blocks and links are zero until the stiffness is assembled; packs are made of the others.
struct ShellRoom {
    uint32_t vertices = 0, elements = 0, hinges = 0, blocks = 0, links = 0, cells = 0, points = 0;
    uint32_t packs() const { return blocks ? (vertices + kLanes - 1) / kLanes : 0; }  // one for 8 vertices
    bool with_springs = false;  // copy_shell: the source's edge springs, too
};

/// What things are made of. Only the game changes it.
struct MaterialRows {
    const Materials& materials;
    const MaterialTraits& material_traits;
};

// Limits that follow from those that a world is given. Hinges: three for two elements, and cuts only remove them.
inline uint32_t hinge_limit(const Limits& l) {
    return l.elements / 2 * 3;
}
inline uint32_t pack_limit(const Limits& l) {
    return l.vertices / kLanes;
}
/// Blocks and links: 8 lanes a slot, 6 to 8 slots of each a pack.
inline uint32_t slot_limit(const Limits& l) {
    return pack_limit(l) * 12;
}
inline uint32_t cell_limit(const Limits& l) {
    return l.vertices / 8;
}
/// Edges: three for two elements and half of one a border edge; a crack doubles those that it cuts. A vertex has about
/// 6 springs, each in a slot of both ends.
inline uint32_t spring_limit(const Limits& l) {
    return l.elements * 2;
}

/// Of metal. Sub-shells: one for a hundred triangles, at least sixteen a shell. A vertex has about 6 edges and a tie,
/// each twice.
inline uint32_t sub_shell_limit(const Limits& l) {
    return l.elements / 64 + 16 * l.shells;
}
inline uint32_t metal_spring_limit(const Limits& l) {
    return l.elements * 4;
}

/// Of solids, all of them together. A solid of 1,500 cells has about 8,000 tetrahedra, 1,500 coarse ones if they are
/// cut in 8, and 2,000 points.
inline uint32_t lattice_limit(const Limits& l) {
    return l.elements / 2;
}
inline uint32_t cooked_limit(const Limits& l) {
    return l.models + l.tasks;
}

/// What bodies are made of, as far as all kinds of structures are alike.
struct TablesOfStructures {
    Limits limits;
    Structures structures{limits.shells, limits.shells};
    Cells cells{cell_limit(limits), limits.shells};
    HullPoints hull_points{cell_limit(limits) * 32, limits.shells};
};
struct StructureRows : MaterialRows, TablesOfStructures {
    StructureRows(const Limits& l, const MaterialRows& of_what) : MaterialRows(of_what), TablesOfStructures{l} {}

    using Below = MaterialRows;
    using Own = TablesOfStructures;
};

inline bool is_shell(const Structures& structures, Row<Structures> structure) {
    return structures.kind[structure] == static_cast<uint8_t>(StructureKind::Shell);
}
/// The row of a structure that is a shell.
inline Row<Shells> shell_of(const Structures& structures, Row<Structures> structure) {
    return Row<Shells>(structures.rows[structure]);
}

/// And solids.
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
    Solids solids{limits.shells, limits.shells};
    SolidMembers solid_members{lattice_limit(limits) / 2, limits.shells};
    MovedNodes moved_nodes{lattice_limit(limits) / 2, limits.shells};
    SkinPoints skin_points{limits.vertices, limits.shells + cooked_limit(limits)};
    SkinTriangles skin_triangles{limits.elements, limits.shells + cooked_limit(limits)};
};
struct SolidRows : StructureRows, TablesOfSolids {
    SolidRows(const Limits& l, const MaterialRows& of_what) : StructureRows(l, of_what), TablesOfSolids{l} {}

    /// What follows from what was cooked, and what breaks work in: no state, made again where it is missing. None until
    /// something may break.
    mutable std::shared_ptr<SolidRooms> solid_rooms;

    using Below = StructureRows;
    using Own = TablesOfSolids;
};
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
Row<CookedSolids> make_cooked(SolidRows& rows, const CookedRoom& room, const char** full = nullptr);
CookedRoom room_of(const SolidRows& rows, Row<CookedSolids> cooked);
/// A structure of one user that has what was cooked; kNone when some table is full. What its rows hold is the caller's
/// affair.
Row<Structures> make_solid(SolidRows& rows, Row<CookedSolids> cooked, const SolidRoom& room,
                           const char** full = nullptr);
SolidRoom solid_room_of(const SolidRows& rows, Row<Structures> structure);
/// One user less; the rows go back when there are none, and those of what was cooked with the last that has it.
void release_solid(SolidRows& rows, Row<Structures> structure);
/// A copy of what the same or another state holds, with one user; in the same state it shares what was cooked.
Row<Structures> import_solid(SolidRows& to, const SolidRows& from, Row<Structures> source, const char** full);

/// The row of a structure that is a solid.
inline Row<Solids> solid_of(const Structures& structures, Row<Structures> structure) {
    return Row<Solids>(structures.rows[structure]);
}

/// What shells come apart into.
struct TablesOfParts {
    Limits limits;
    ShellParts shell_parts{(limits.tasks + 1) * kMostParts};
};
struct PartRows : SolidRows, TablesOfParts {
    PartRows(const Limits& l, const MaterialRows& of_what) : SolidRows(l, of_what), TablesOfParts{l} {
        shell_parts.append((l.tasks + 1) * kMostParts);
    }

    using Below = SolidRows;
    using Own = TablesOfParts;
};

/// And sub-shells and springs of those that are of metal.
struct TablesOfMetal {
    Limits limits;
    MetalShells metal_shells{limits.shells, limits.shells};
    MetalOwners metal_owners{limits.shells};
    SubShells sub_shells{sub_shell_limit(limits), limits.shells};
    SubShellBorders sub_shell_borders{8 * sub_shell_limit(limits), limits.shells};
    MetalVertices metal_vertices{limits.vertices, limits.shells};
    MetalElements metal_elements{limits.elements, limits.shells};
    MetalSprings metal_springs{metal_spring_limit(limits), limits.shells};
    MetalRuns metal_runs{limits.tasks};
    MetalImpacts metal_impacts{limits.bodies};
    StrikerFronts striker_fronts{limits.tasks * kFrontRows};
    MetalPresses metal_presses{limits.bodies};
};
struct MetalRows : PartRows, TablesOfMetal {
    MetalRows(const Limits& l, const MaterialRows& of_what) : PartRows(l, of_what), TablesOfMetal{l} {}

    using Below = PartRows;
    using Own = TablesOfMetal;
};

/// Shells, what holds them together, and the springs of those that have some.
struct TablesOfShells {
    Limits limits;
    Shells shells{limits.shells, limits.shells};
    Vertices vertices{limits.vertices, limits.shells};
    Elements elements{limits.elements, limits.shells};
    TriangleSprings triangle_springs{limits.elements};
    Hinges hinges{hinge_limit(limits), limits.shells};
    StiffnessPacks stiffness_packs{pack_limit(limits), limits.shells};
    StiffnessBlocks stiffness_blocks{slot_limit(limits), limits.shells};
    StiffnessLinks stiffness_links{slot_limit(limits), limits.shells};
    ShellSprings shell_springs{limits.shells, limits.shells};
    Springs springs{spring_limit(limits), limits.shells};
    LayerSprings layer_springs{spring_limit(limits), limits.shells};
    ElementSprings element_springs{limits.elements, limits.shells};
    SpringPacks spring_packs{pack_limit(limits), limits.shells};
    SpringSlots spring_slots{slot_limit(limits), limits.shells};
    LayerSlots layer_slots{slot_limit(limits), limits.shells};
    Twins twins{limits.vertices, limits.shells};
    VertexBlocks vertex_blocks{limits.vertices / kVerticesPerBlock + 1};
};
struct ShellRows : MetalRows, TablesOfShells {
    ShellRows(const Limits& l, const MaterialRows& of_what) : MetalRows(l, of_what), TablesOfShells{l} {}

    mutable ScratchMemory scratch;  // of functions that need more than a stack holds

    Row<Shells> shell_of(Row<Structures> structure) const { return cullet::shell_of(structures, structure); }
    /// Of a structure that is a shell; none: it is not of metal.
    Row<MetalShells> metal_of(Row<Structures> structure) const {
        return is_shell(structures, structure) ? metal_owners.of(shell_of(structure)) : Row<MetalShells>();
    }

    using Below = MetalRows;
    using Own = TablesOfShells;

    /// Calls f(range, table, room, limit) for each table of which a shell has a range: the member of ShellRoom that
    /// says how many rows it wants, and the limit that is named when there are none.
    template <class Rows, class F>
    static void for_each_range(Rows& rows, Row<Structures> structure, F&& f) {
        auto& s = rows.shells;
        const Row<Shells> shell = rows.shell_of(structure);
        f(s.vertices[shell], rows.vertices, &ShellRoom::vertices, "limits.vertices");
        f(s.elements[shell], rows.elements, &ShellRoom::elements, "limits.elements");
        f(s.hinges[shell], rows.hinges, &ShellRoom::hinges, "limits.elements");
        f(s.packs[shell], rows.stiffness_packs, &ShellRoom::packs, "limits.vertices");
        f(s.blocks[shell], rows.stiffness_blocks, &ShellRoom::blocks, "limits.vertices");
        f(s.links[shell], rows.stiffness_links, &ShellRoom::links, "limits.vertices");
        f(rows.structures.cells[structure], rows.cells, &ShellRoom::cells, "limits.vertices");
        f(rows.structures.points[structure], rows.hull_points, &ShellRoom::points, "limits.vertices");
    }
};

/// What a shell uses now: room for a copy of it.
ShellRoom room_of(const ShellRows& state, Row<Structures> shell);

/// A shell with empty ranges of these capacities and one user, or kNone when some table is full (`full` then names its
/// limit). Vertex rows start all dead (element kNone, inverse mass 0).
Row<Structures> make_shell(ShellRows& state, const ShellRoom& room, const char** full = nullptr);
/// The same with rows that hold whatever they held; who fills them calls clear_pack_ends when the counts are set.
Row<Structures> make_shell_unclear(ShellRows& state, const ShellRoom& room, const char** full = nullptr);
/// Clears what kernels read behind the counts, because they take whole packs. That is all vertices to spare, which
/// cracks take one by one, and the last pack of elements. Other elements to spare are cleared with their pack when its
/// first one is taken. Hinges are cleared when they are taken.
void clear_pack_ends(ShellRows& state, Row<Structures> shell);
/// Gives the assembled stiffness back: the next task assembles it anew.
void drop_stiffness(ShellRows& state, Row<Structures> shell);
/// A range of HullPoints; false: no room.
bool take_points(StructureRows& state, uint32_t count, Range& range);
/// One user less; the rows go back when there are none.
void release_shell(ShellRows& state, Row<Structures> shell);
/// Rows that the springs of a shell need. No layers: one layer.
struct SpringRoom {
    uint32_t springs = 0, elements = 0, vertices = 0, slots = 0;
    bool has_layers = false;
    bool clears_lists = true;  // springs, slots and both of the layers; false: each row is written before it is read
};
/// A row with empty ranges of these capacities, for a shell that has none; kNone when some table is full. All is zero
/// but for lists that are not to be cleared.
Row<ShellSprings> make_springs(ShellRows& state, Row<Structures> shell, const SpringRoom& room,
                               const char** full = nullptr);
/// Of the shell; kNone when it has none.
Row<ShellSprings> springs_of(const ShellRows& state, Row<Structures> shell);
/// The shell's springs, if any, go back; release_shell does it, too.
void release_springs(ShellRows& state, Row<Structures> shell);
/// Springs of `copy` as `source` has them, in motion as they are. What there are too few rows for is refused. A shell
/// without springs gives none. `copy` has at least the vertices and elements of `source`.
bool copy_springs(ShellRows& state, Row<Structures> source, Row<Structures> copy, const char** full = nullptr);

/// Rows that a shell needs as metal.
struct MetalRoom {
    uint32_t vertices = 0, elements = 0, springs = 0, cells = 0, borders = 0;
};
/// A row with empty ranges of these capacities for a shell that has none; kNone when some table is full. What the rows
/// hold is the caller's affair.
Row<MetalShells> make_metal(ShellRows& state, Row<Structures> shell, const MetalRoom& room,
                            const char** full = nullptr);
MetalRoom metal_room_of(const ShellRows& state, Row<Structures> shell);
/// Calls f(range, table, rows wanted, limit) for each table of which a metal shell has a range.
template <class Rows, class F>
void for_each_metal_range(Rows& rows, Row<MetalShells> row, const MetalRoom& room, F&& f) {
    auto& own = rows.metal_shells;
    f(own.vertices[row], rows.metal_vertices, room.vertices, "limits.vertices");
    f(own.elements[row], rows.metal_elements, room.elements, "limits.elements");
    f(own.springs[row], rows.metal_springs, room.springs, "limits.elements");
    f(own.cells[row], rows.sub_shells, room.cells, "limits.elements");
    f(own.borders[row], rows.sub_shell_borders, room.borders, "limits.elements");
}
/// They go back, if there are any; release_shell does it, too.
void release_metal(ShellRows& state, Row<Structures> shell);
/// Into the rows of a shell that make_metal made with room for them.
void copy_metal_rows(ShellRows& to, const ShellRows& from, Row<Structures> source, Row<Structures> copy);

/// A copy of `source` with `room` (at least what is in use), one user. Stiffness is copied when `room.blocks` > 0,
/// springs when `room.with_springs`.
Row<Structures> copy_shell(ShellRows& state, Row<Structures> source, const ShellRoom& room,
                           const char** full = nullptr);

/// What both rows of `source` say, into those of `copy`, which keeps its users, ranges and springs.
void copy_values(ShellRows& to, const ShellRows& from, Row<Structures> source, Row<Structures> copy);

/// The second half of copy_shell, into a shell that make_shell made: serial systems reserve, parallel ones copy.
void copy_shell_rows(ShellRows& to, const ShellRows& from, Row<Structures> source, Row<Structures> copy,
                     bool with_stiffness);

/// The tables of one structure that is a shell, with its row among shells looked up: what the functions that edit a
/// shell pass around. Indices are relative to the shell, as in the columns.
struct ShellView {
    ShellRows& state;
    Row<Structures> structure;
    Row<Shells> row;

    ShellView(ShellRows& s, Row<Structures> of) : state(s), structure(of), row(s.shell_of(of)) {}
    Structures& structures() const { return state.structures; }
    Shells& shells() const { return state.shells; }
    Range& cells() const { return state.structures.cells[structure]; }
    Range& points() const { return state.structures.points[structure]; }
    Range& vertices() const { return state.shells.vertices[row]; }
    Range& elements() const { return state.shells.elements[row]; }
    Range& hinges() const { return state.shells.hinges[row]; }
    /// Table rows of relative indices.
    uint32_t vertex(uint32_t v) const { return vertices().first + v; }
    uint32_t element(uint32_t e) const { return elements().first + e; }
    uint32_t hinge(uint32_t h) const { return hinges().first + h; }
    uint32_t vertex_count() const { return vertices().count; }
    uint32_t element_count() const { return elements().count; }
    uint32_t hinge_count() const { return hinges().count; }
};

template <>
inline constexpr uint32_t kRowsPerChunk<StiffnessPacks> = 32;  // 256 vertices

}  // namespace cullet
