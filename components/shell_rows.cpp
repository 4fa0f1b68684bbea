#include "components/shell_rows.hpp"

#include <algorithm>
#include <array>
#include <functional>

namespace cullet {
namespace {

// Whoever had these rows before kept sums of others.
void forget_blocks(VertexBlocks& blocks, const Range& vertices) {
    const uint32_t first = vertices.first / kVerticesPerBlock;
    const uint32_t end = (vertices.first + vertices.capacity + kVerticesPerBlock - 1) / kVerticesPerBlock;
    for (uint8_t* flags : {blocks.sums.data(), blocks.moves.data()}) std::fill(flags + first, flags + end, uint8_t{0});
}

}  // namespace

ShellRoom room_of(const ShellRows& rows, Row<Structures> structure) {
    ShellRoom room;
    const Structures& structures = rows.structures;
    const Shells& s = rows.shells;
    const Row<Shells> shell = rows.shell_of(structure);
    room.vertices = s.vertices[shell].capacity;
    room.elements = s.elements[shell].count;
    room.hinges = s.hinges[shell].count;
    room.blocks = s.blocks[shell].count;
    room.links = s.links[shell].count;
    room.cells = structures.cells[structure].count;
    room.points = structures.points[structure].count;
    return room;
}

Row<Structures> make_shell_unclear(ShellRows& rows, const ShellRoom& room, const char** full) {
    Structures& structures = rows.structures;
    Shells& s = rows.shells;
    Range row, shell_row;
    if (!structures.take(1, row)) {
        if (full) *full = "limits.structures";
        return {};
    }
    if (!s.take(1, shell_row)) {
        structures.give_back(row);
        if (full) *full = "limits.structures";
        return {};
    }
    const Row<Structures> structure(row.first);
    const Row<Shells> shell(shell_row.first);
    structures.clear_rows(structure, 1);
    structures.kind[structure] = static_cast<uint8_t>(StructureKind::Shell);
    structures.rows[structure] = shell;
    structures.users[structure] = 1;
    s.clear_rows(shell, 1);
    s.springs[shell] = {};
    const char* missing = nullptr;  // the first
    ShellRows::for_each_range(rows, structure, [&](Range& range, auto& table, auto wanted, const char* limit) {
        if (!table.take(std::invoke(wanted, room), range) && !missing) missing = limit;
    });
    rows.triangle_springs.reach(rows.elements.size());
    forget_blocks(rows.vertex_blocks, s.vertices[shell]);
    if (missing) {
        release_shell(rows, structure);
        if (full) *full = missing;
        return {};
    }
    return structure;
}

void clear_pack_ends(ShellRows& rows, Row<Structures> structure) {
    const ShellView shell(rows, structure);
    const Range vertices = shell.vertices(), elements = shell.elements();
    rows.vertices.clear_spare(vertices);
    for (uint32_t v = vertices.count; v < rows.vertices.pool.rounded(vertices.capacity); ++v)
        rows.vertices.element[vertices.first + v] = kNone;
    rows.stiffness_packs.clear_spare(rows.shells.packs[shell.row]);
    if (elements.count % kLanes == 0) return;
    const uint32_t behind = elements.first + elements.count, lanes = kLanes - elements.count % kLanes;
    rows.elements.clear_rows(behind, lanes);
    rows.triangle_springs.clear_rows(behind, lanes);
}

Row<Structures> make_shell(ShellRows& rows, const ShellRoom& room, const char** full) {
    const Row<Structures> structure = make_shell_unclear(rows, room, full);
    if (!structure.exists()) return structure;
    clear_pack_ends(rows, structure);
    const ShellView shell(rows, structure);
    const Range& elements = shell.elements();
    rows.elements.clear_spare(elements);
    rows.triangle_springs.clear_rows(elements.first, rows.elements.pool.rounded(elements.capacity));
    rows.hinges.clear_spare(shell.hinges());
    return structure;
}

void drop_stiffness(ShellRows& rows, Row<Structures> structure) {
    Shells& s = rows.shells;
    const Row<Shells> shell = rows.shell_of(structure);
    rows.stiffness_packs.give_back(s.packs[shell]);
    rows.stiffness_blocks.give_back(s.blocks[shell]);
    rows.stiffness_links.give_back(s.links[shell]);
    s.packs[shell] = s.blocks[shell] = s.links[shell] = {};
}

void release_shell(ShellRows& rows, Row<Structures> structure) {
    Structures& structures = rows.structures;
    CULLET_ASSERT(structures.users[structure] > 0, "structure %u released more often than taken", structure.index);
    if (--structures.users[structure] > 0) return;
    const Row<Shells> shell = rows.shell_of(structure);
    release_springs(rows, structure);
    ShellRows::for_each_range(rows, structure,
                              [&](Range& range, auto& table, auto, const char*) { table.give_back(range); });
    rows.shells.clear_rows(shell, 1);
    rows.shells.pool.give_back(shell, 1);
    structures.clear_rows(structure, 1);
    structures.pool.give_back(structure, 1);
}

namespace {

constexpr size_t kRanges = 8;

/// Of a structure's rows in both tables, what a copy of them must not take over.
struct OwnRows {
    uint32_t users, row;
    Row<ShellSprings> springs;
    std::array<Range, kRanges> ranges;
};
OwnRows own_rows(const ShellRows& rows, Row<Structures> structure) {
    const Row<Shells> shell = rows.shell_of(structure);
    OwnRows own{rows.structures.users[structure], shell, rows.shells.springs[shell], {}};
    size_t k = 0;
    ShellRows::for_each_range(rows, structure,
                              [&](const Range& range, const auto&, auto, const char*) { own.ranges[k++] = range; });
    return own;
}

}  // namespace

void copy_values(ShellRows& to, const ShellRows& from, Row<Structures> source, Row<Structures> copy) {
    const OwnRows own = own_rows(to, copy);
    const Row<Shells> shell(own.row);
    to.structures.copy_rows(from.structures, source, copy, 1);
    to.shells.copy_rows(from.shells, from.shell_of(source), shell, 1);
    to.structures.users[copy] = own.users;
    to.structures.rows[copy] = own.row;
    to.shells.springs[shell] = own.springs;
    size_t k = 0;
    ShellRows::for_each_range(to, copy, [&](Range& range, auto&, auto, const char*) { range = own.ranges[k++]; });
}

void copy_shell_rows(ShellRows& to, const ShellRows& from, Row<Structures> source, Row<Structures> copy,
                     bool with_stiffness) {
    const OwnRows given = own_rows(from, source), own = own_rows(to, copy);
    copy_values(to, from, source, copy);
    size_t k = 0;
    ShellRows::for_each_range(to, copy, [&](Range& range, auto& table, auto, const char*) {
        using Rows = std::remove_reference_t<decltype(table)>;
        constexpr bool is_stiffness = std::is_same_v<Rows, StiffnessPacks> || std::is_same_v<Rows, StiffnessBlocks> ||
                                      std::is_same_v<Rows, StiffnessLinks>;
        constexpr bool is_optional = std::is_same_v<Rows, Cells> || std::is_same_v<Rows, HullPoints>;
        const Range found = given.ranges[k], room = own.ranges[k];
        ++k;
        const bool is_wanted = is_stiffness ? with_stiffness : !is_optional || room.capacity > 0;
        const uint32_t count = is_wanted ? found.count : 0;
        CULLET_ASSERT(count <= room.capacity, "copy of %s: %u rows do not fit %u", table.name(), count, room.capacity);
        range = {room.first, count, room.capacity};
        if (count) table.copy_rows(table_in<Rows>(from), found.first, room.first, count);
        if constexpr (std::is_same_v<Rows, Elements>)
            to.triangle_springs.copy_rows(from.triangle_springs, found.first, room.first, count);
    });
    // The number of cells says how stiffness is stored (pair_cells.hpp).
    CULLET_ASSERT(to.shells.packs[to.shell_of(copy)].count == 0 ||
                      to.structures.cells[copy].count == from.structures.cells[source].count,
                  "copy of structure %u has its stiffness but %u of its %u cells", source.index,
                  to.structures.cells[copy].count, from.structures.cells[source].count);
}

Row<Structures> copy_shell(ShellRows& rows, Row<Structures> source, const ShellRoom& room, const char** full) {
    const Row<Structures> copy = make_shell(rows, room, full);
    if (!copy.exists()) return copy;
    copy_shell_rows(rows, rows, source, copy, room.blocks > 0);
    if (room.with_springs && !copy_springs(rows, source, copy, full)) {
        release_shell(rows, copy);
        return {};
    }
    return copy;
}

}  // namespace cullet
