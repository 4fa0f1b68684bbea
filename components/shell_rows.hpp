// All rows that shells are made of, as one parameter. What edits, copies and measures shells reaches these tables and
// no others.
#pragma once
#include "components/shell_parts.hpp"
#include "components/shells.hpp"
#include "components/springs.hpp"
#include "components/structure_rows.hpp"
#include "components/vertex_blocks.hpp"

namespace cullet {

/// Rows that a shell needs. Blocks and links are zero until the stiffness is assembled; packs are made of the others.
struct ShellRoom {
    uint32_t vertices = 0, elements = 0, hinges = 0, blocks = 0, links = 0, cells = 0, points = 0;
    uint32_t packs() const { return blocks ? (vertices + kLanes - 1) / kLanes : 0; }  // one for 8 vertices
    bool with_springs = false;  // copy_shell: the source's edge springs, too
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
/// Edges: three for two elements and half of one a border edge; a crack doubles those that it cuts. A vertex has about
/// 6 springs, each in a slot of both ends.
inline uint32_t spring_limit(const Limits& l) {
    return l.elements * 2;
}

/// The row of a structure that is a shell.
inline Row<Shells> shell_of(const Structures& structures, Row<Structures> structure) {
    return Row<Shells>(structures.rows[structure]);
}

/// What shells come apart into.
struct TablesOfParts {
    Limits limits;
    ShellParts shell_parts{(limits.tasks + 1) * kMostParts};
};
struct PartRows : StructureRows, TablesOfParts {
    PartRows(const Limits& l, const MaterialRows& of_what) : StructureRows(l, of_what), TablesOfParts{l} {
        shell_parts.append((l.tasks + 1) * kMostParts);
    }

    using Below = StructureRows;
    using Own = TablesOfParts;
};

/// Shells, what holds them together, and the springs of those that have some.
struct TablesOfShells {
    Limits limits;
    Shells shells{limits.structures, limits.structures};
    Vertices vertices{limits.vertices, limits.structures};
    Elements elements{limits.elements, limits.structures};
    TriangleSprings triangle_springs{limits.elements};
    Hinges hinges{hinge_limit(limits), limits.structures};
    StiffnessPacks stiffness_packs{pack_limit(limits), limits.structures};
    StiffnessBlocks stiffness_blocks{slot_limit(limits), limits.structures};
    StiffnessLinks stiffness_links{slot_limit(limits), limits.structures};
    ShellSprings shell_springs{limits.structures, limits.structures};
    Springs springs{spring_limit(limits), limits.structures};
    LayerSprings layer_springs{spring_limit(limits), limits.structures};
    ElementSprings element_springs{limits.elements, limits.structures};
    SpringPacks spring_packs{pack_limit(limits), limits.structures};
    SpringSlots spring_slots{slot_limit(limits), limits.structures};
    LayerSlots layer_slots{slot_limit(limits), limits.structures};
    Twins twins{limits.vertices, limits.structures};
    VertexBlocks vertex_blocks{limits.vertices / kVerticesPerBlock + 1};
};
struct ShellRows : PartRows, TablesOfShells {
    ShellRows(const Limits& l, const MaterialRows& of_what) : PartRows(l, of_what), TablesOfShells{l} {}

    /// In a list of tables: all of these.
    template <class Self>
    struct Named {
        Self& shell_rows;
        operator Self&() const { return shell_rows; }
        static constexpr auto of(auto& rows) -> decltype((rows.shell_rows)) { return rows.shell_rows; }
    };
    Row<Shells> shell_of(Row<Structures> structure) const { return cullet::shell_of(structures, structure); }

    using Below = PartRows;
    using Own = TablesOfShells;

    /// Calls f(range, table, room, limit) for each table of which a shell has a range. `room` is the member of
    /// ShellRoom that says how many rows it wants. `limit` is named when there are none.
    template <class Rows, class F>
    static void for_each_range(Rows& rows, Row<Structures> structure, F&& f) {
        auto& s = rows.shells;
        const Row<Shells> shell = cullet::shell_of(rows.structures, structure);
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

/// A copy of `source` with `room` (at least what is in use), one user. Stiffness is copied when `room.blocks` > 0,
/// springs when `room.with_springs`.
Row<Structures> copy_shell(ShellRows& state, Row<Structures> source, const ShellRoom& room,
                           const char** full = nullptr);

/// What both rows of `source` say, into those of `copy`, which keeps its users, ranges and springs.
void copy_values(ShellRows& to, const ShellRows& from, Row<Structures> source, Row<Structures> copy);

/// The second half of copy_shell, into a shell that make_shell made: serial systems reserve, parallel ones copy.
void copy_shell_rows(ShellRows& to, const ShellRows& from, Row<Structures> source, Row<Structures> copy,
                     bool with_stiffness);

/// One structure that is a shell, in a set or a list of tables, with its row among shells looked up. The functions that
/// edit or look at a shell pass it around. Indices are relative to the shell, as in the columns.
template <class Rows>
struct ShellIn {
    Rows state;
    Row<Structures> structure;
    Row<Shells> row;

    ShellIn(Rows s, Row<Structures> of) : state(s), structure(of), row(shell_of(s.structures, of)) {}
    /// Of a view of more.
    template <class More>
    requires std::is_convertible_v<const More&, Rows> ShellIn(const ShellIn<More>& o)
        : state(o.state), structure(o.structure), row(o.row) {}

    auto& structures() const { return state.structures; }
    auto& shells() const { return state.shells; }
    auto& cells() const { return state.structures.cells[structure]; }
    auto& points() const { return state.structures.points[structure]; }
    auto& vertices() const { return state.shells.vertices[row]; }
    auto& elements() const { return state.shells.elements[row]; }
    auto& hinges() const { return state.shells.hinges[row]; }
    /// Table rows of relative indices.
    uint32_t vertex(uint32_t v) const { return vertices().first + v; }
    uint32_t element(uint32_t e) const { return elements().first + e; }
    uint32_t hinge(uint32_t h) const { return hinges().first + h; }
    uint32_t vertex_count() const { return vertices().count; }
    uint32_t element_count() const { return elements().count; }
    uint32_t hinge_count() const { return hinges().count; }
};
using ShellView = ShellIn<ShellRows&>;

template <>
inline constexpr uint32_t kRowsPerChunk<StiffnessPacks> = 32;  // 256 vertices

}  // namespace cullet
