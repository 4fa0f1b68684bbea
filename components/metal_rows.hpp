// What shells of metal have beside the rows of a shell.
#pragma once
#include "components/bodies.hpp"
#include "components/metal.hpp"
#include "components/shell_rows.hpp"
#include "components/tasks.hpp"

namespace cullet {

/// Of metal. Sub-shells: one for a hundred triangles, at least sixteen a shell. A vertex has about 6 edges and a tie,
/// each twice.
inline uint32_t sub_shell_limit(const Limits& l) {
    return l.elements / 64 + 16 * l.structures;
}
inline uint32_t metal_spring_limit(const Limits& l) {
    return l.elements * 4;
}

/// Sub-shells and springs of shells that are of metal, and the impacts on them.
struct TablesOfMetal {
    Limits limits;
    MetalShells metal_shells{limits.structures, limits.structures};
    MetalOwners metal_owners{limits.structures};
    SubShells sub_shells{sub_shell_limit(limits), limits.structures};
    SubShellBorders sub_shell_borders{8 * sub_shell_limit(limits), limits.structures};
    MetalVertices metal_vertices{limits.vertices, limits.structures};
    MetalElements metal_elements{limits.elements, limits.structures};
    MetalSprings metal_springs{metal_spring_limit(limits), limits.structures};
    MetalRuns metal_runs{limits.tasks};
    MetalImpacts metal_impacts{limits.bodies};
    StrikerFronts striker_fronts{limits.tasks * kFrontRows};
    MetalPresses metal_presses{limits.bodies};
};
/// What a shell has as metal.
using MetalTables = Tables<const Structures, MetalShells, MetalOwners, SubShells, SubShellBorders, MetalVertices,
                           MetalElements, MetalSprings>;

/// Shells with what they have as metal, those that are of metal.
using MetalShellRows = All<ShellRows, MetalTables>;

/// An impact on a shell of metal: the shell, its working copy, the task, and who struck whom.
using MetalRows = All<MetalShellRows, MetalRuns, MetalImpacts, StrikerFronts, MetalPresses, Tasks, TaskContacts,
                      HiddenRuns, Bodies, const PinBoxes, const ViewVertices, const ViewIndices>;

/// How large a shell of metal is, if it is one.
using MetalSizes = Tables<const Structures, const MetalOwners, const MetalShells>;

/// Of a structure that is a shell; none: it is not of metal.
inline Row<MetalShells> metal_of(Tables<const Structures, const MetalOwners> rows, Row<Structures> structure) {
    return is_shell(rows.structures, structure) ? rows.metal_owners.of(shell_of(rows.structures, structure))
                                                : Row<MetalShells>();
}

/// Rows that a shell needs as metal.
struct MetalRoom {
    uint32_t vertices = 0, elements = 0, springs = 0, cells = 0, borders = 0;
};
/// A row with empty ranges of these capacities for a shell that has none; kNone when some table is full. What the rows
/// hold is the caller's affair.
Row<MetalShells> make_metal(MetalTables rows, Row<Structures> shell, const MetalRoom& room,
                            const char** full = nullptr);
MetalRoom metal_room_of(Read<MetalTables> rows, Row<Structures> shell);
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
/// They go back, if there are any; release_metal_shell does it, too.
void release_metal(MetalTables rows, Row<Structures> shell);
/// Into the rows of a shell that make_metal made with room for them.
void copy_metal_rows(MetalTables to, Read<MetalTables> from, Row<Structures> source, Row<Structures> copy);

/// One user less; the rows go back when there are none, and those of metal, if it has some, before.
void release_metal_shell(MetalShellRows rows, Row<Structures> shell);

}  // namespace cullet
