#include "components/shell_rows.hpp"

#include <algorithm>
#include <array>
#include <functional>

namespace cullet {
namespace {

// Hinges: three for two elements, and cuts only remove them. Blocks and links: 8 lanes a slot, 6 to 8 slots of each a
// pack.
uint32_t hinge_limit(const Limits& l) {
    return l.elements / 2 * 3;
}
uint32_t pack_limit(const Limits& l) {
    return l.vertices / kLanes;
}
uint32_t slot_limit(const Limits& l) {
    return pack_limit(l) * 12;
}
uint32_t cell_limit(const Limits& l) {
    return l.vertices / 8;
}
// Edges: three for two elements and half of one a border edge; a crack doubles those that it cuts. A vertex has about 6
// springs, each in a slot of both ends.
uint32_t spring_limit(const Limits& l) {
    return l.elements * 2;
}

// Whoever had these rows before kept sums of others.
void forget_blocks(VertexBlocks& blocks, const Range& vertices) {
    const uint32_t first = vertices.first / kVerticesPerBlock;
    const uint32_t end = (vertices.first + vertices.capacity + kVerticesPerBlock - 1) / kVerticesPerBlock;
    for (uint8_t* flags : {blocks.sums.data(), blocks.moves.data()}) std::fill(flags + first, flags + end, uint8_t{0});
}

template <class T>
const T& table_of(const ShellRows& rows) {
    const T* found = nullptr;
    ShellRows::for_each_range(rows, [&](const auto&, const auto& table, auto, const char*) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(table)>, T>) found = &table;
    });
    return *found;
}

}  // namespace

ShellRows::ShellRows(const Limits& l, const MaterialRows& of_what)
    : MaterialRows(of_what),
      shells(l.shells, l.shells),
      vertices(l.vertices, l.shells),
      elements(l.elements, l.shells),
      triangle_springs(l.elements),
      hinges(hinge_limit(l), l.shells),
      stiffness_packs(pack_limit(l), l.shells),
      stiffness_blocks(slot_limit(l), l.shells),
      stiffness_links(slot_limit(l), l.shells),
      cells(cell_limit(l), l.shells),
      hull_points(cell_limit(l) * 32, l.shells),
      shell_springs(l.shells, l.shells),
      springs(spring_limit(l), l.shells),
      layer_springs(spring_limit(l), l.shells),
      element_springs(l.elements, l.shells),
      spring_packs(pack_limit(l), l.shells),
      spring_slots(slot_limit(l), l.shells),
      layer_slots(slot_limit(l), l.shells),
      twins(l.vertices, l.shells),
      vertex_blocks(l.vertices / kVerticesPerBlock + 1) {}

ShellRoom room_of(const ShellRows& rows, Row<Shells> shell) {
    const Shells& s = rows.shells;
    ShellRoom room;
    room.vertices = s.vertices[shell].capacity;
    room.elements = s.elements[shell].count;
    room.hinges = s.hinges[shell].count;
    room.blocks = s.blocks[shell].count;
    room.links = s.links[shell].count;
    room.cells = s.cells[shell].count;
    room.points = s.points[shell].count;
    return room;
}

Row<Shells> make_shell_unclear(ShellRows& rows, const ShellRoom& room, const char** full) {
    Shells& s = rows.shells;
    Range row_range;
    if (!s.take(1, row_range)) {
        if (full) *full = "limits.shells";
        return {};
    }
    const Row<Shells> shell(row_range.first);
    s.clear_rows(shell, 1);
    const char* missing = nullptr;  // the first
    ShellRows::for_each_range(rows, [&](Column<Range>& range, auto& table, auto wanted, const char* limit) {
        if (!table.take(std::invoke(wanted, room), range[shell]) && !missing) missing = limit;
    });
    rows.triangle_springs.reach(rows.elements.size());
    s.users[shell] = 1;
    forget_blocks(rows.vertex_blocks, s.vertices[shell]);
    if (missing) {
        release_shell(rows, shell);
        if (full) *full = missing;
        return {};
    }
    return shell;
}

void clear_pack_ends(ShellRows& rows, Row<Shells> shell) {
    const Shells& s = rows.shells;
    const Range vertices = s.vertices[shell], elements = s.elements[shell];
    rows.vertices.clear_spare(vertices);
    for (uint32_t v = vertices.count; v < rows.vertices.pool.rounded(vertices.capacity); ++v)
        rows.vertices.element[vertices.first + v] = kNone;
    rows.stiffness_packs.clear_spare(s.packs[shell]);
    if (elements.count % kLanes == 0) return;
    const uint32_t behind = elements.first + elements.count, lanes = kLanes - elements.count % kLanes;
    rows.elements.clear_rows(behind, lanes);
    rows.triangle_springs.clear_rows(behind, lanes);
}

Row<Shells> make_shell(ShellRows& rows, const ShellRoom& room, const char** full) {
    const Row<Shells> shell = make_shell_unclear(rows, room, full);
    if (!shell.exists()) return shell;
    clear_pack_ends(rows, shell);
    const Range& elements = rows.shells.elements[shell];
    rows.elements.clear_spare(elements);
    rows.triangle_springs.clear_rows(elements.first, rows.elements.pool.rounded(elements.capacity));
    rows.hinges.clear_spare(rows.shells.hinges[shell]);
    return shell;
}

void drop_stiffness(ShellRows& rows, Row<Shells> shell) {
    Shells& s = rows.shells;
    rows.stiffness_packs.give_back(s.packs[shell]);
    rows.stiffness_blocks.give_back(s.blocks[shell]);
    rows.stiffness_links.give_back(s.links[shell]);
    s.packs[shell] = s.blocks[shell] = s.links[shell] = {};
}

bool take_points(ShellRows& rows, uint32_t count, Range& range) {
    return rows.hull_points.take(count, range);
}

void release_shell(ShellRows& rows, Row<Shells> shell) {
    Shells& s = rows.shells;
    CULLET_ASSERT(s.users[shell] > 0, "shell %u released more often than taken", shell.index);
    if (--s.users[shell] > 0) return;
    ShellRows::for_each_range(
        rows, [&](Column<Range>& range, auto& table, auto, const char*) { table.give_back(range[shell]); });
    release_springs(rows, shell);
    s.clear_rows(shell, 1);
    s.pool.give_back(shell, 1);
}

// The source's ranges are copied with its row; ours are put back in their place.
void copy_shell_rows(ShellRows& to, const ShellRows& from, Row<Shells> source, Row<Shells> copy, bool with_stiffness) {
    Shells& s = to.shells;
    std::array<Range, 8> own;
    size_t k = 0;
    ShellRows::for_each_range(to, [&](Column<Range>& range, auto&, auto, const char*) { own[k++] = range[copy]; });
    const uint32_t users = s.users[copy];
    s.copy_rows(from.shells, source, copy, 1);
    s.users[copy] = users;
    k = 0;
    ShellRows::for_each_range(to, [&](Column<Range>& range, auto& table, auto, const char*) {
        using Rows = std::remove_reference_t<decltype(table)>;
        constexpr bool is_stiffness = std::is_same_v<Rows, StiffnessPacks> || std::is_same_v<Rows, StiffnessBlocks> ||
                                      std::is_same_v<Rows, StiffnessLinks>;
        constexpr bool is_optional = std::is_same_v<Rows, Cells> || std::is_same_v<Rows, HullPoints>;
        const Range found = range[copy], room = own[k++];
        const bool is_wanted = is_stiffness ? with_stiffness : !is_optional || room.capacity > 0;
        const uint32_t count = is_wanted ? found.count : 0;
        CULLET_ASSERT(count <= room.capacity, "copy of %s: %u rows do not fit %u", table.name(), count, room.capacity);
        range[copy] = {room.first, count, room.capacity};
        if (count) table.copy_rows(table_of<Rows>(from), found.first, room.first, count);
        if constexpr (std::is_same_v<Rows, Elements>)
            to.triangle_springs.copy_rows(from.triangle_springs, found.first, room.first, count);
    });
    // The number of cells says how stiffness is stored (pair_cells.hpp).
    CULLET_ASSERT(s.packs[copy].count == 0 || s.cells[copy].count == from.shells.cells[source].count,
                  "copy of shell %u has its stiffness but %u of its %u cells", source.index, s.cells[copy].count,
                  from.shells.cells[source].count);
}

Row<Shells> copy_shell(ShellRows& rows, Row<Shells> source, const ShellRoom& room, const char** full) {
    const Row<Shells> copy = make_shell(rows, room, full);
    if (!copy.exists()) return copy;
    copy_shell_rows(rows, rows, source, copy, room.blocks > 0);
    if (room.with_springs && !copy_springs(rows, source, copy, full)) {
        release_shell(rows, copy);
        return {};
    }
    return copy;
}

}  // namespace cullet
